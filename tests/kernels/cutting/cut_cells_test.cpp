// Cells of an arrangement: the regions found after cutting are those of an exact computation that knows no triangles.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include "io/read_input.h"
#include "kernels/cutting/cut_surfaces.h"
#include "kernels/cutting/exact_reference.h"
#include "kernels/cutting/surfaces.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"
#include "properties/rotation.h"
#include "support/sanitized.h"

namespace strataflow {
namespace {

std::vector<double> sorted(std::vector<double> volumes) {
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

struct Cells {
  StructuralModel model;
  std::vector<double> volumes;  ///< ascending
};

/// Cuts, checks what every cut must hold, and builds.
Cells cells_of(const TriangleSoup& soup, const std::function<bool(const Vec3&)>& is_kept = {}) {
  Result<CutResult> cut = cut_surfaces(soup);
  EXPECT_TRUE(cut) << describe(cut.failure());
  EXPECT_EQ(cut->report.pairs_left, 0u);
  const Result<CutResult> again = cut_surfaces(cut->soup);
  EXPECT_TRUE(again);
  EXPECT_EQ(again->report.cut_triangles, 0u) << "cutting again must change nothing (A5)";
  EXPECT_EQ(again->soup.triangles, cut->soup.triangles);
  if (is_kept) {
    TriangleSoup& kept = cut->soup;
    std::size_t next = 0;
    for (std::size_t t = 0; t < kept.triangles.size(); ++t) {
      const Triangle& v = kept.triangles[t];
      if (!std::all_of(v.begin(), v.end(), [&](std::uint32_t p) { return is_kept(kept.points[p]); })) continue;
      kept.triangles[next] = v;
      kept.triangle_patch[next++] = kept.triangle_patch[t];
    }
    kept.triangles.resize(next);
    kept.triangle_patch.resize(next);
  }
  Result<BuiltModel> built = build_structural_model(cut->soup);
  EXPECT_TRUE(built) << describe(built.failure());
  Cells cells;
  for (const Region& region : built->model.regions) cells.volumes.push_back(region.volume_m3);
  cells.volumes = sorted(cells.volumes);
  cells.model = std::move(built->model);
  return cells;
}

void expect_volumes(const std::vector<double>& found, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], tolerance);
}

// ---- Boxes along the axes, by flooding the grid of their coordinates ----

struct Block {
  Vec3 low, high;
};

/// Volumes of the bounded cells of all boxes' faces, ascending.
std::vector<double> flooded_cells(const std::vector<Block>& blocks) {
  std::array<std::vector<double>, 3> at;
  for (int axis = 0; axis < 3; ++axis) {
    std::set<double> values;
    for (const Block& b : blocks) values.insert({b.low[axis], b.high[axis]});
    at[axis].assign(values.begin(), values.end());
    at[axis].insert(at[axis].begin(), at[axis].front() - 1);
    at[axis].push_back(at[axis].back() + 1);
  }
  using Cell = std::array<int, 3>;
  const auto middle = [&](const Cell& c, int axis) { return 0.5 * (at[axis][c[axis]] + at[axis][c[axis] + 1]); };
  const auto is_walled = [&](const Cell& c, int axis) {  // between c and the next one along axis
    return std::any_of(blocks.begin(), blocks.end(), [&](const Block& b) {
      const double x = at[axis][c[axis] + 1];
      if (b.low[axis] != x && b.high[axis] != x) return false;
      for (int other = 0; other < 3; ++other)
        if (other != axis && (middle(c, other) < b.low[other] || middle(c, other) > b.high[other])) return false;
      return true;
    });
  };
  std::set<Cell> seen;
  std::vector<double> volumes;
  const Cell size{static_cast<int>(at[0].size()) - 1, static_cast<int>(at[1].size()) - 1,
                  static_cast<int>(at[2].size()) - 1};
  bool is_outside = true;  // the first one
  for (Cell seed{0, 0, 0}; seed[0] < size[0]; ++seed[0])
    for (seed[1] = 0; seed[1] < size[1]; ++seed[1])
      for (seed[2] = 0; seed[2] < size[2]; ++seed[2]) {
        if (!seen.insert(seed).second) continue;
        std::vector<Cell> stack{seed};
        double volume = 0;
        while (!stack.empty()) {
          const Cell c = stack.back();
          stack.pop_back();
          volume += (at[0][c[0] + 1] - at[0][c[0]]) * (at[1][c[1] + 1] - at[1][c[1]]) * (at[2][c[2] + 1] - at[2][c[2]]);
          for (int axis = 0; axis < 3; ++axis) {
            Cell next = c;
            if (++next[axis] < size[axis] && !is_walled(c, axis) && seen.insert(next).second) stack.push_back(next);
            next[axis] -= 2;
            if (next[axis] >= 0 && !is_walled(next, axis) && seen.insert(next).second) stack.push_back(next);
          }
        }
        if (!is_outside) volumes.push_back(volume);
        is_outside = false;
      }
  return sorted(volumes);
}

TriangleSoup soup_of(const std::vector<Block>& blocks) {
  TriangleSoup soup;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    support::add_box(soup, support::add_patch(soup, "box" + std::to_string(i), Role::boundary), blocks[i].low,
                     blocks[i].high);
  return soup;
}

TEST(CutCells, of_two_and_three_crossing_cubes_are_counted) {
  const std::vector<Block> two{{{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}}};
  EXPECT_EQ(flooded_cells(two), (std::vector<double>{1, 7, 7}));
  expect_volumes(cells_of(soup_of(two)).volumes, {1, 7, 7}, 1e-12);
  std::vector<Block> three = two;
  three.push_back({{-1, 0.5, 0.5}, {4, 1.5, 1.5}});
  expect_volumes(cells_of(soup_of(three)).volumes, flooded_cells(three), 1e-12);
}

TEST(CutCells, of_boxes_with_faces_edges_and_corners_in_common_are_those_of_the_grid) {
  for (std::uint64_t seed = 0; seed < (support::sanitized ? 3 : 40); ++seed) {
    RandomStream random(seed);
    std::vector<Block> blocks;
    while (blocks.size() < 2 + seed % 4) {
      Block b;
      for (int axis = 0; axis < 3; ++axis) {
        b.low[axis] = static_cast<double>(random.below(4));
        b.high[axis] = b.low[axis] + 1 + static_cast<double>(random.below(3));
      }
      blocks.push_back(b);
    }
    expect_volumes(cells_of(soup_of(blocks)).volumes, flooded_cells(blocks), 1e-12);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

std::filesystem::path arrangement(const char* file) {
  const char* folder = std::getenv("STRATAFLOW_DATA");
  return (folder ? std::filesystem::path(folder) : std::filesystem::path(STRATAFLOW_SOURCE_DIR) / "../shared/data") /
         "arrangement" / file;
}

TEST(CutCells, of_the_three_cubes_are_those_of_the_grid) {
  const std::filesystem::path file = arrangement("three_cubes.stl");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here (set STRATAFLOW_DATA)";
  const Result<InputData> input = read_input(file);
  ASSERT_TRUE(input);
  const TriangleSoup& soup = input->surfaces;
  ASSERT_EQ(soup.triangles.size(), 36u);
  std::vector<Block> blocks;
  for (std::size_t first = 0; first < 36; first += 12) {
    Box3 box;
    for (std::size_t t = first; t < first + 12; ++t)
      for (const std::uint32_t v : soup.triangles[t]) box.take(soup.points[v]);
    blocks.push_back({box.low, box.high});
  }
  const Cells cells = cells_of(soup);
  expect_volumes(cells.volumes, flooded_cells(blocks), 1e-12);
  EXPECT_GE(cells.volumes.size(), 4u);
}

// ---- Planes in a box (euler1999 §4.2 test 11), by slicing convex cells exactly ----

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Polygon = std::vector<Point>;
using Convex = std::vector<Polygon>;  ///< its faces

Kernel::FT six_volumes(const Convex& cell) {
  Kernel::FT sum = 0;
  const Point origin = cell[0][0];
  for (const Polygon& face : cell)
    for (std::size_t i = 2; i < face.size(); ++i)
      sum += CGAL::abs(CGAL::determinant(face[0] - origin, face[i - 1] - origin, face[i] - origin));
  return sum;
}

/// The part of a cell on one side of a plane; empty without volume.
Convex part_of(const Convex& cell, const Kernel::Plane_3& plane, CGAL::Sign side) {
  const auto side_of = [&](const Point& p) {
    const auto s = plane.oriented_side(p);
    return static_cast<int>(s) * static_cast<int>(side);
  };
  Convex part;
  std::map<Point, std::vector<Point>> cap_edges;
  bool has_inside = false;
  for (const Polygon& face : cell) {
    Polygon clipped;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Point &p = face[i], &q = face[(i + 1) % face.size()];
      if (side_of(p) >= 0) clipped.push_back(p);
      has_inside = has_inside || side_of(p) > 0;
      if (side_of(p) * side_of(q) < 0) {
        const Kernel::FT a = plane.a() * p.x() + plane.b() * p.y() + plane.c() * p.z() + plane.d();
        const Kernel::FT b = plane.a() * q.x() + plane.b() * q.y() + plane.c() * q.z() + plane.d();
        clipped.push_back(p + (a / (a - b)) * (q - p));
      }
    }
    if (clipped.size() < 3) continue;
    if (std::all_of(clipped.begin(), clipped.end(), [&](const Point& p) { return plane.has_on(p); })) continue;
    part.push_back(clipped);
    for (std::size_t i = 0; i < clipped.size(); ++i) {
      const Point &p = clipped[i], &q = clipped[(i + 1) % clipped.size()];
      if (plane.has_on(p) && plane.has_on(q)) {
        cap_edges[p].push_back(q);
        cap_edges[q].push_back(p);
      }
    }
  }
  if (!has_inside) return {};
  if (cap_edges.size() > 2) {
    Polygon cap{cap_edges.begin()->first};
    Point before = cap[0], at = cap_edges.begin()->second[0];
    while (at != cap[0]) {
      cap.push_back(at);
      const std::vector<Point>& next = cap_edges[at];
      const Point onward = next[0] == before ? next[1] : next[0];
      before = at;
      at = onward;
    }
    part.push_back(cap);
  }
  return part;
}

Convex cube(double size) {
  const auto p = [&](int i) { return Point(i & 1 ? size : 0, i & 2 ? size : 0, i & 4 ? size : 0); };
  Convex faces;
  for (const auto& f : {std::array{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}})
    faces.push_back({p(f[0]), p(f[1]), p(f[2]), p(f[3])});
  return faces;
}

/// Planes as triangles that reach far beyond the box [0, size]³.
void expect_cells_of_planes(const std::vector<std::array<Vec3, 3>>& planes, double size) {
  TriangleSoup soup = support::box({0, 0, 0}, {size, size, size});
  std::vector<Convex> cells{cube(size)};
  for (const auto& t : planes) {
    support::add_triangle(soup, support::add_patch(soup, "P" + std::to_string(soup.entities.size())), t[0], t[1], t[2]);
    const Kernel::Plane_3 plane(Point(t[0].x, t[0].y, t[0].z), Point(t[1].x, t[1].y, t[1].z),
                                Point(t[2].x, t[2].y, t[2].z));
    std::vector<Convex> parts;
    for (const Convex& cell : cells)
      for (const CGAL::Sign side : {CGAL::POSITIVE, CGAL::NEGATIVE}) {
        Convex part = part_of(cell, plane, side);
        if (!part.empty()) parts.push_back(std::move(part));
      }
    cells = std::move(parts);
  }
  Kernel::FT total = 0;
  std::vector<double> expected;
  for (const Convex& cell : cells) {
    total += six_volumes(cell);
    expected.push_back(CGAL::to_double(six_volumes(cell)) / 6);
  }
  ASSERT_EQ(total, Kernel::FT(6) * size * size * size) << "the reference itself must fill the box";
  const Cells found = cells_of(soup, [&](const Vec3& p) {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x <= size && p.y <= size && p.z <= size;
  });
  const double box = size * size * size;
  expect_volumes(found.volumes, sorted(expected), 1e-9 * box);
  double sum = 0;
  for (const double v : found.volumes) sum += v;
  EXPECT_NEAR(sum, box, 1e-9 * box);
}

std::array<Vec3, 3> enlarged(const std::array<Vec3, 3>& t, double factor) {
  return {t[0] + factor * (2.0 * t[0] - t[1] - t[2]), t[1] + factor * (2.0 * t[1] - t[2] - t[0]),
          t[2] + factor * (2.0 * t[2] - t[0] - t[1])};
}

TEST(CutCells, of_two_to_eight_random_planes_in_a_box_are_those_of_exact_slicing) {
  for (std::uint64_t seed = 0; seed < (support::sanitized ? 2 : 28); ++seed) {
    RandomStream random(100 + seed);
    std::vector<std::array<Vec3, 3>> planes;
    while (planes.size() < 2 + seed % 7) {
      std::array<Vec3, 3> t;
      for (Vec3& p : t) p = {10 * random.unit(), 10 * random.unit(), 10 * random.unit()};
      if (length(cross(t[1] - t[0], t[2] - t[0])) > 5) planes.push_back(enlarged(t, 1000));
    }
    expect_cells_of_planes(planes, 10);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

TEST(CutCells, of_planes_through_common_points_and_lines_are_those_of_exact_slicing) {
  for (std::uint64_t seed = 0; seed < (support::sanitized ? 2 : 42); ++seed) {
    RandomStream random(200 + seed);
    std::vector<std::array<Vec3, 3>> planes;
    while (planes.size() < 2 + seed % 7) {  // on a grid of 5 points a side: faces of the box and equal planes included
      std::array<Vec3, 3> t;
      for (Vec3& p : t)
        p = {static_cast<double>(random.below(5)), static_cast<double>(random.below(5)),
             static_cast<double>(random.below(5))};
      if (!(cross(t[1] - t[0], t[2] - t[0]) == Vec3{})) planes.push_back(enlarged(t, 1000));
    }
    expect_cells_of_planes(planes, 4);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

// ---- euler1999 §4.2 tests 1 and 8 ----

TriangleSoup partition(int horizons, const std::function<Vec3(const Vec3&)>& moved) {
  TriangleSoup soup = support::box({0, 0, 0}, {10, 10, 10});
  for (Vec3& p : soup.points) p = moved(p);
  const double heights[] = {5, 2};
  for (int h = 0; h < horizons; ++h)
    support::add_grid(soup, "H" + std::to_string(h + 1), Role::horizon, 3, {-1, -2, heights[h]}, {12, 0, 0}, {0, 13, 0},
                      moved);
  support::add_grid(soup, "F1", Role::fault, 2, {5, -1, -1}, {0, 12, 0}, {0, 0, 13}, moved);
  return soup;
}

void add_disc(TriangleSoup& soup, const Vec3& centre, double radius) {
  const std::uint32_t patch = support::add_patch(soup, "disc", Role::fault);
  for (int i = 0; i < 12; ++i) {
    const auto rim = [&](int k) {
      return centre + radius * Vec3{std::cos(k * 0.5235987755982988), 0, std::sin(k * 0.5235987755982988)};
    };
    support::add_triangle(soup, patch, centre, rim(i), rim((i + 1) % 12));
  }
}

/// Volume of what is added, an octahedron turned inside the left upper block.
double add_body(TriangleSoup& soup, const Vec3& centre, double radius) {
  const std::uint32_t patch = support::add_patch(soup, "body", Role::intrusion);
  const Vec3 x{radius, 0, 0}, y{0, radius, 0}, z{0, 0, radius};
  for (const double s : {1.0, -1.0})
    for (const double t : {1.0, -1.0})
      for (const double u : {1.0, -1.0})
        support::add_triangle(soup, patch, centre + s * x, centre + t * y, centre + u * z);
  return 4.0 / 3 * radius * radius * radius;
}

TEST(CutCells, partition_a_box_as_test_1_says) {
  const auto still = [](const Vec3& p) { return p; };
  for (const bool is_turned : {false, true}) {
    const std::function<Vec3(const Vec3&)> moved = is_turned
                                                       ? std::function<Vec3(const Vec3&)>(support::about_skew_axis)
                                                       : std::function<Vec3(const Vec3&)>(still);
    // Horizons and fault overshoot the box; four blocks of 250, and six with the second horizon.
    expect_volumes(cells_of(partition(1, moved)).volumes, {250, 250, 250, 250}, 1e-9);
    expect_volumes(cells_of(partition(2, moved)).volumes, {100, 100, 150, 150, 250, 250}, 1e-9);
  }
}

TEST(CutCells, count_no_region_for_a_disc_and_one_for_a_closed_body) {
  TriangleSoup soup = partition(1, [](const Vec3& p) { return p; });
  add_disc(soup, {2, 7, 8}, 1);
  const Cells with_disc = cells_of(soup);
  expect_volumes(with_disc.volumes, {250, 250, 250, 250}, 1e-9);
  EXPECT_EQ(std::count_if(with_disc.model.frontiers.begin(), with_disc.model.frontiers.end(),
                          [](const Frontier& f) { return f.volume_sign == 0 && f.region != universe; }),
            1);
  const double body = add_body(soup, {2.5, 3, 7.5}, 1.5);
  expect_volumes(cells_of(soup).volumes, {body, 250 - body, 250, 250, 250}, 1e-9);
}

TEST(CutCells, sort_faces_round_an_edge_though_the_smallest_angle_is_1e_10) {
  // Half planes x ≥ 0 from the z axis, at slopes that differ by little, closed by one wall at x = 1: k − 1 wedges
  // whose volumes are half their heights on the wall.
  for (const int k : {2, 3, 5, 8}) {
    TriangleSoup soup;
    std::vector<double> slopes, expected;
    for (int i = 0; i < k; ++i) slopes.push_back(i % 2 == 0 ? 0.1 * i : 0.1 * (i - 1) + 1e-10);
    for (int i = 0; i < k; ++i)
      support::add_quad(soup, support::add_patch(soup, "F" + std::to_string(i), Role::fault), {0, 0, 0},
                        {2, 2 * slopes[i], 0}, {2, 2 * slopes[i], 1}, {0, 0, 1});
    support::add_quad(soup, support::add_patch(soup, "wall", Role::boundary), {1, -1, -1}, {1, 2, -1}, {1, 2, 2},
                      {1, -1, 2});
    for (const double z : {0.0, 1.0})
      support::add_quad(soup, support::add_patch(soup, z == 0 ? "floor" : "roof", Role::boundary), {-1, -1, z},
                        {2, -1, z}, {2, 2, z}, {-1, 2, z});
    for (int i = 0; i + 1 < k; ++i) expected.push_back(0.5 * (slopes[i + 1] - slopes[i]));
    const Cells cells = cells_of(soup, [](const Vec3& p) { return p.x <= 1; });
    expect_volumes(cells.volumes, sorted(expected), 1e-15);
    ASSERT_FALSE(HasFailure()) << k << " faces";
  }
}

}  // namespace
}  // namespace strataflow
