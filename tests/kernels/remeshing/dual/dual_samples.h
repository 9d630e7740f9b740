#pragma once
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/remeshing/dual/clean_up_dual.h"
#include "kernels/remeshing/dual/dual_polygons.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/voronoi/diagram_samples.h"

namespace strataflow::sample {

/// Meshes as patches of one soup, each an entity of its own.
class Patches {
 public:
  Patches& add(const std::string& name, Role role, const Mesh& mesh) {
    const auto offset = static_cast<std::uint32_t>(soup_.points.size());
    const auto patch = static_cast<std::uint32_t>(soup_.patch_entity.size());
    soup_.points.insert(soup_.points.end(), mesh.points.begin(), mesh.points.end());
    for (const auto& [a, b, c] : mesh.triangles) {
      soup_.triangles.push_back({a + offset, b + offset, c + offset});
      soup_.triangle_patch.push_back(patch);
    }
    soup_.patch_entity.push_back(patch);
    soup_.entities.push_back({name, role});
    return *this;
  }
  const TriangleSoup& soup() const { return soup_; }
  StructuralModel model() const { return build_structural_model(soup_)->model; }

 private:
  TriangleSoup soup_;
};

/// The rectangle origin + [0, 1] u + [0, 1] v in nu × nv squares of two triangles. Points are computed from their
/// indices alone, so rectangles with a common edge share its points.
inline Mesh rectangle(const Vec3& origin, const Vec3& u, const Vec3& v, std::uint32_t nu, std::uint32_t nv) {
  Mesh mesh;
  for (std::uint32_t j = 0; j <= nv; ++j)
    for (std::uint32_t i = 0; i <= nu; ++i) mesh.points.push_back(origin + (double(i) / nu) * u + (double(j) / nv) * v);
  for (std::uint32_t j = 0; j < nv; ++j)
    for (std::uint32_t i = 0; i < nu; ++i) {
      const std::uint32_t a = j * (nu + 1) + i, b = a + 1, c = a + nu + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

/// A planar star with `arms` arms round the origin: tips at distance 1, necks at `neck`.
inline Mesh star(std::uint32_t arms, double neck) {
  Mesh mesh;
  mesh.points.push_back({0, 0, 0});
  for (std::uint32_t k = 0; k < 2 * arms; ++k) {
    const double angle = 3.14159265358979 * k / arms, radius = k % 2 == 0 ? 1 : neck;
    mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  for (std::uint32_t k = 0; k < 2 * arms; ++k) mesh.triangles.push_back({0, 1 + k, 1 + (k + 1) % (2 * arms)});
  return mesh;
}

/// Random star-shaped outline.
inline Mesh random_star(unsigned seed) {
  RandomStream random(seed);
  const std::uint32_t count = 5 + static_cast<std::uint32_t>(random.unit() * 12);
  Mesh mesh;
  mesh.points.push_back({0, 0, 0});
  for (std::uint32_t k = 0; k < count; ++k) {
    const double angle = 6.28318530717958 * k / count, radius = 0.15 + 0.85 * random.unit();
    mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  for (std::uint32_t k = 0; k < count; ++k) mesh.triangles.push_back({0, 1 + k, 1 + (k + 1) % count});
  return mesh;
}

/// Three sheets that meet along the x axis, with a fourth across them: contacts, corners and free borders.
inline StructuralModel junction() {
  const Vec3 x{1, 0, 0};
  Patches patches;
  for (const double side : {0.0, 0.5}) {  // halves left and right of the fourth sheet
    const std::string half = side == 0 ? "left" : "right";
    patches.add("H-" + half, Role::horizon, rectangle({side, 0, 0}, 0.5 * x, {0, 0.5, 0}, 4, 4));
    patches.add("G-" + half, Role::horizon, rectangle({side, 0, 0}, 0.5 * x, {0, -0.5, 0}, 4, 4));
    patches.add("F-" + half, Role::fault, rectangle({side, 0, 0}, 0.5 * x, {0, 0, -0.5}, 4, 4));
  }
  const Vec3 middle{0.5, 0, 0};
  patches.add("C-east", Role::fault, rectangle(middle, {0, 0.5, 0}, {0, 0, -0.5}, 4, 4));
  patches.add("C-west", Role::fault, rectangle(middle, {0, -0.5, 0}, {0, 0, -0.5}, 4, 4));
  return patches.model();
}

inline StructuralModel reference(std::string_view name, double resolution_m) {
  return build_structural_model(*generate_reference_model(name, {.resolution_m = resolution_m}))->model;
}

/// A model with its dual and everything on the way.
struct Dual {
  StructuralModel model;
  RestrictedDiagram diagram;
  CellComponents components;
  ComponentPoints points;
  DualMesh mesh;
};

inline Dual dual_of(StructuralModel model, const std::vector<Vec3>& sites, const MergeOptions& options = {}) {
  Dual dual;
  dual.model = std::move(model);
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  dual.diagram = restrict_to_triangles(dual.model.points, dual.model.triangles, neighbours);
  dual.components = *find_cell_components(dual.model, dual.diagram, sites.size());
  dual.points = place_component_points(dual.model, dual.diagram, dual.components, options);
  dual.mesh = build_dual_polygons(dual.model, dual.diagram, dual.components, dual.points);
  return dual;
}

inline MergeOptions no_merging() { return {.merges_linked_corners = false, .merges_beyond_two_points = false}; }

inline std::vector<Vec3> sites_in_box(const StructuralModel& model, std::size_t count, unsigned seed) {
  return random_sites(count, seed, model.box.low, model.box.high);
}

/// Rules S1 and S2 (pellerin2014 §3) for each surface of a dual: inside, every edge is used as often in one direction
/// as in the other; along a line once for every border of the surface there, by all surfaces of the line.
inline void expect_conforming(const StructuralModel& model, const DualMesh& mesh) {
  using Edge = std::array<std::uint32_t, 3>;  // surface, lower point, higher point
  struct Use {
    int net = 0, count = 0, borders = 0;
  };
  std::map<Edge, Use> uses;
  const auto edge = [](std::uint32_t surface, std::uint32_t a, std::uint32_t b) {
    return Edge{surface, std::min(a, b), std::max(a, b)};
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      ASSERT_NE(a, b);
      Use& use = uses[edge(mesh.triangle_surface[t], a, b)];
      use.net += a < b ? 1 : -1;
      ++use.count;
    }
  for (std::size_t l = 0; l < mesh.line_points.size(); ++l)
    for (std::size_t i = 1; i < mesh.line_points[l].size(); ++i)
      for (const std::uint32_t surface : model.lines[l].surfaces)
        ++uses[edge(surface, mesh.line_points[l][i - 1], mesh.line_points[l][i])].borders;
  for (const auto& [where, use] : uses) {
    EXPECT_LE(std::abs(use.net), use.borders) << "an edge inside surface " << where[0] << " has a side alone";
    EXPECT_EQ((use.net + use.borders) % 2, 0) << "surface " << where[0] << " leaves its line";
    EXPECT_EQ((use.count + use.borders) % 2, 0);
  }
}

/// V − E + F of the triangles together with the edges of lines, which stay where merging left surfaces no triangle.
inline std::int64_t euler_of(const DualMesh& mesh) {
  std::vector<std::uint32_t> points;
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      points.push_back(t[k]);
      edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
    }
  for (const auto& along : mesh.line_points)
    for (std::size_t i = 0; i < along.size(); ++i) {
      points.push_back(along[i]);
      if (i > 0) edges.push_back({std::min(along[i - 1], along[i]), std::max(along[i - 1], along[i])});
    }
  const auto count = [](auto& items) {
    std::sort(items.begin(), items.end());
    return static_cast<std::int64_t>(std::unique(items.begin(), items.end()) - items.begin());
  };
  return count(points) - count(edges) + static_cast<std::int64_t>(mesh.triangles.size());
}

}  // namespace strataflow::sample
