#include "kernels/reference_models/closed_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "kernels/reference_models/polygon_triangulation.h"
#include "kernels/reference_models/reference_plans.h"
#include "kernels/reference_models/sheet_soup.h"

namespace strataflow {
namespace {

/// An icosahedron whose edges are divided into `parts`, points moved onto the unit sphere; seen from outside its
/// triangles turn counter-clockwise.
void unit_sphere(std::uint32_t parts, std::vector<Vec3>& points, std::vector<Triangle>& triangles) {
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  const std::array<Vec3, 12> corners{Vec3{-1, golden, 0}, {1, golden, 0}, {-1, -golden, 0}, {1, -golden, 0},
                                     {0, -1, golden},     {0, 1, golden}, {0, -1, -golden}, {0, 1, -golden},
                                     {golden, 0, -1},     {golden, 0, 1}, {-golden, 0, -1}, {-golden, 0, 1}};
  const std::array<Triangle, 20> faces{Triangle{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                       {1, 5, 9},          {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                       {3, 9, 4},          {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                       {4, 9, 5},          {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  // A point is known by how much it takes of each corner, so that faces share it to the bit.
  std::map<std::array<std::array<std::uint32_t, 2>, 3>, std::uint32_t> number;
  for (const Triangle& face : faces) {
    const auto point = [&](std::uint32_t i, std::uint32_t j) {
      std::array<std::array<std::uint32_t, 2>, 3> key{{{face[0], parts - i - j}, {face[1], i}, {face[2], j}}};
      for (auto& [corner, share] : key) corner = share > 0 ? corner : 12;
      std::sort(key.begin(), key.end());
      const auto [at, is_new] = number.emplace(key, static_cast<std::uint32_t>(points.size()));
      if (is_new) {
        Vec3 sum;
        for (const auto& [corner, share] : key)
          if (share > 0) sum = sum + double(share) * corners[corner];
        points.push_back((1 / length(sum)) * sum);
      }
      return at->second;
    };
    for (std::uint32_t j = 0; j < parts; ++j)
      for (std::uint32_t i = 0; i + j < parts; ++i) {
        triangles.push_back({point(i, j), point(i + 1, j), point(i, j + 1)});
        if (i + j + 1 < parts) triangles.push_back({point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
      }
  }
}

void add_ball(SheetSoup& sheets, std::uint32_t entity, double mean_radius_m, double edge_m,
              const std::function<double(const Vec3&)>& radius_m) {
  constexpr double icosahedron_edge = 1.0515;  // of the unit sphere
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  unit_sphere(static_cast<std::uint32_t>(std::max(2.0, std::round(icosahedron_edge * mean_radius_m / edge_m))), points,
              triangles);
  for (Vec3& p : points) p = Vec3{100, 100, 100} + radius_m(p) * p;
  sheets.add_sheet(entity, points, triangles);
}

constexpr double plate_x = 1000, plate_y = 800;

std::uint32_t parts_of(double length_m, double edge_m) {
  return static_cast<std::uint32_t>(std::max(1.0, std::round(length_m / edge_m)));
}

}  // namespace

TriangleSoup nested_spheres(double edge_m) {
  SheetSoup sheets({{"Inner", Role::horizon}, {"Middle", Role::horizon}, {"Outer", Role::boundary}});
  std::uint32_t entity = 0;
  for (const double radius : {70.0, 90.0, 100.0})
    add_ball(sheets, entity++, radius, edge_m, [&](const Vec3&) { return radius; });
  return sheets.take();
}

TriangleSoup smooth_closed_surface(double edge_m) {
  SheetSoup sheets({{"Skin", Role::boundary}});
  add_ball(sheets, 0, 90, edge_m,
           [](const Vec3& p) { return 80 + 18 * p.x * p.x * p.x - 22 * p.y * p.y + 30 * p.x * p.y * p.z + 10 * p.z; });
  return sheets.take();
}

TriangleSoup torus(double edge_m) {
  constexpr double ring = 70, tube = 30, turn = 2 * std::numbers::pi;
  const std::uint32_t around = std::max(8u, parts_of(turn * ring, edge_m)), across = std::max(8u, parts_of(turn * tube, edge_m));
  SheetSoup sheets({{"Skin", Role::boundary}});
  sheets.add_grid(0, around + 1, across + 1, [&](std::uint32_t i, std::uint32_t j) {
    // The last column and row are the first again, bit for bit, so that welding closes the ring.
    const double u = turn * (double(i % around) / around), v = turn * (double(j % across) / across);
    const double r = ring + tube * std::cos(v);
    return Vec3{r * std::cos(u), r * std::sin(u), tube * std::sin(v)};
  });
  return sheets.take_welded();
}

TriangleSoup slab(double edge_m) {
  SheetSoup sheets({{"Top", Role::boundary},
                    {"Bottom", Role::boundary},
                    {"North", Role::boundary},
                    {"South", Role::boundary},
                    {"East", Role::boundary},
                    {"West", Role::boundary}});
  sheets.add_box_sides(0, {0, 0, 0}, {plate_x, plate_y, 20}, edge_m);
  return sheets.take_welded();
}

TriangleSoup wedge(double edge_m) {
  SheetSoup sheets({{"Top", Role::boundary},
                    {"Bottom", Role::boundary},
                    {"North", Role::boundary},
                    {"South", Role::boundary},
                    {"West", Role::boundary}});
  const std::uint32_t columns = parts_of(plate_x, edge_m), rows = parts_of(plate_y, edge_m);
  const auto x = [&](std::uint32_t i) { return plate_x * (double(i) / columns); };
  const auto y = [&](std::uint32_t j) { return plate_y * (double(j) / rows); };
  const auto top_z = [&](std::uint32_t i) { return 60 * (1 - double(i) / columns); };
  sheets.add_grid(0, columns + 1, rows + 1, [&](std::uint32_t i, std::uint32_t j) {
    return Vec3{x(i), y(j), top_z(i)};
  });
  sheets.add_grid(1, columns + 1, rows + 1, [&](std::uint32_t i, std::uint32_t j) { return Vec3{x(i), y(j), 0}; });
  const auto height = [&](std::uint32_t i, std::uint32_t k) {
    return top_z(i) * (double(k) / parts_of(top_z(i), edge_m));
  };
  for (const std::uint32_t side : {2u, 3u}) {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> before, column;
    for (std::uint32_t i = 0; i <= columns; ++i) {
      column.clear();
      for (std::uint32_t k = 0; k <= (i < columns ? parts_of(top_z(i), edge_m) : 0); ++k) {
        column.push_back(static_cast<std::uint32_t>(points.size()));
        points.push_back({x(i), side == 2 ? plate_y : 0, i < columns ? height(i, k) : 0});
      }
      if (i > 0) triangulate_strip(before, column, points, triangles);
      before = column;
    }
    sheets.add_sheet(side, points, triangles);
  }
  sheets.add_grid(4, rows + 1, parts_of(top_z(0), edge_m) + 1, [&](std::uint32_t j, std::uint32_t k) {
    return Vec3{0, y(j), height(0, k)};
  });
  return sheets.take_welded();
}

}  // namespace strataflow
