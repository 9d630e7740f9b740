// Rules H1 to H8 of pellerin2014 §3, one by one, by plain code of their own: nothing here is shared with the mesher.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/hybrid/fill_hybrid.h"
#include "remeshed_model.h"

namespace strataflow {
namespace {

struct MeshedModel {
  std::string name;
  StructuralModel model;
  HybridMesh hybrid;
};

/// A layer that pinches out, an angular part, a faulted fold, a smooth body: thin zones, sites inside.
const std::vector<MeshedModel>& meshed_models() {
  static const std::vector<MeshedModel> meshed = [] {
    std::vector<MeshedModel> made;
    for (const auto& [name, count, edge, layers] : {std::tuple{"wedge", 200, 100.0, 2},
                                                    {"bracket", 250, 25.0, 1},
                                                    {"B", 250, 260.0, 1},
                                                    {"smooth-closed", 200, 27.0, 1}}) {
      StructuralModel model = support::remeshed(name, static_cast<std::size_t>(count), edge);
      Result<HybridMesh> hybrid =
          fill_hybrid(model, sites_of_points(model), {.layers_through_thin = layers}, nullptr, support::tet_worker());
      EXPECT_TRUE(hybrid) << name << ": " << (hybrid ? "" : hybrid.failure().what);
      if (hybrid) made.push_back({name, std::move(model), std::move(*hybrid)});
    }
    return made;
  }();
  return meshed;
}

using Cycle = std::vector<std::uint32_t>;

std::span<const std::uint32_t> corners_of(const VolumeMesh& mesh, std::size_t cell) {
  return {&mesh.cell_vertices[mesh.cell_offsets[cell]], static_cast<std::size_t>(vertex_count(mesh.cell_types[cell]))};
}

/// The faces of a cell in VTK's order of vertices, counter-clockwise seen from outside.
std::vector<Cycle> faces_of(const VolumeMesh& mesh, std::size_t cell) {
  static const std::map<CellType, std::vector<std::vector<std::size_t>>> local{
      {CellType::tetrahedron, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}},
      {CellType::pyramid, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}},
      {CellType::prism, {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}}};
  std::vector<Cycle> faces;
  for (const auto& face : local.at(mesh.cell_types[cell])) {
    faces.emplace_back();
    for (const std::size_t k : face) faces.back().push_back(corners_of(mesh, cell)[k]);
  }
  return faces;
}

/// The same for both ways round and any start.
Cycle canonical(Cycle cycle) {
  std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
  if (cycle[1] > cycle.back()) std::reverse(cycle.begin() + 1, cycle.end());
  return cycle;
}

std::map<Cycle, std::vector<std::size_t>> cells_by_face(const VolumeMesh& mesh) {
  std::map<Cycle, std::vector<std::size_t>> cells;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    for (const Cycle& face : faces_of(mesh, c)) cells[canonical(face)].push_back(c);
  return cells;
}

/// How often each triangle of the model's surfaces is a face, or half of a quadrilateral, of a cell.
std::map<Cycle, std::size_t> uses_of_triangles(const MeshedModel& meshed) {
  std::map<Cycle, std::size_t> uses;
  for (const Triangle& t : meshed.model.triangles) uses[canonical({t[0], t[1], t[2]})] = 0;
  for (const auto& [face, cells] : cells_by_face(meshed.hybrid.mesh)) {
    if (face.size() == 3) {
      if (const auto found = uses.find(face); found != uses.end()) found->second += cells.size();
      continue;
    }
    for (std::size_t k = 0; k < 4; ++k)
      if (const auto half = uses.find(canonical({face[k], face[(k + 1) % 4], face[(k + 2) % 4]})); half != uses.end())
        half->second += cells.size();
  }
  return uses;
}

TEST(HybridRules, H1_every_cell_is_a_tetrahedron_a_pyramid_or_a_prism) {
  ASSERT_EQ(meshed_models().size(), 4u);
  std::set<CellType> seen;
  for (const MeshedModel& meshed : meshed_models())
    seen.insert(meshed.hybrid.mesh.cell_types.begin(), meshed.hybrid.mesh.cell_types.end());
  EXPECT_EQ(seen, (std::set<CellType>{CellType::tetrahedron, CellType::pyramid, CellType::prism}));
}

TEST(HybridRules, H2_faces_inside_have_two_cells_and_every_triangle_of_the_surfaces_is_used) {
  for (const MeshedModel& meshed : meshed_models()) {
    const VolumeMesh& mesh = meshed.hybrid.mesh;
    std::map<Cycle, std::size_t> surfaces;  // of these, how many sides are in a region
    for (const Surface& surface : meshed.model.surfaces)
      for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
        const Triangle& v = meshed.model.triangles[t];
        surfaces[canonical({v[0], v[1], v[2]})] =
            (surface.region_minus != universe ? 1u : 0u) + (surface.region_plus != universe ? 1u : 0u);
      }
    for (const auto& [triangle, uses] : uses_of_triangles(meshed))
      ASSERT_EQ(uses, surfaces.at(triangle)) << meshed.name << " " << triangle[0];
    for (const auto& [face, cells] : cells_by_face(mesh)) {
      ASSERT_LE(cells.size(), 2u) << meshed.name;
      if (cells.size() == 2) continue;
      bool is_outside = surfaces.count(face) > 0;  // or two of its triangles side by side
      for (std::size_t k = 0; k < 2 && face.size() == 4; ++k)
        is_outside |= surfaces.count(canonical({face[k], face[k + 1], face[k + 2]})) > 0 &&
                      surfaces.count(canonical({face[k], face[k + 2], face[(k + 3) % 4]})) > 0;
      ASSERT_TRUE(is_outside) << meshed.name;
    }
  }
}

TEST(HybridRules, H3_all_corners_turn_the_right_way) {
  for (const MeshedModel& meshed : meshed_models()) {
    const VolumeMesh& mesh = meshed.hybrid.mesh;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const auto corners = corners_of(mesh, c);
      const auto turn = [&](std::size_t at, std::size_t i, std::size_t j, std::size_t k) {
        return orientation_3d(mesh.points[corners[at]], mesh.points[corners[i]], mesh.points[corners[j]],
                              mesh.points[corners[k]]);
      };
      if (mesh.cell_types[c] == CellType::tetrahedron) {
        ASSERT_EQ(turn(0, 1, 2, 3), 1) << meshed.name;
      }
      for (std::size_t k = 0; k < 4 && mesh.cell_types[c] == CellType::pyramid; ++k)
        ASSERT_EQ(turn(k, (k + 1) % 4, (k + 3) % 4, 4), 1) << meshed.name;
      for (std::size_t k = 0; k < 3 && mesh.cell_types[c] == CellType::prism; ++k) {
        ASSERT_EQ(turn(k, (k + 2) % 3, (k + 1) % 3, k + 3), 1) << meshed.name;
        ASSERT_EQ(turn(k + 3, 3 + (k + 1) % 3, 3 + (k + 2) % 3, k), 1) << meshed.name;
      }
    }
  }
}

TEST(HybridRules, H4_cells_add_up_to_what_the_surfaces_enclose) {
  for (const MeshedModel& meshed : meshed_models()) {
    const VolumeMesh& mesh = meshed.hybrid.mesh;
    const Vec3 origin = mesh.points[0];
    const auto cone = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      return dot(mesh.points[a] - origin, cross(mesh.points[b] - origin, mesh.points[c] - origin)) / 6;
    };
    std::vector<double> cells(meshed.model.regions.size(), 0), enclosed(meshed.model.regions.size(), 0);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c)
      for (const Cycle& f : faces_of(mesh, c)) {
        double& sum = cells[static_cast<std::size_t>(mesh.cell_region[c])];
        if (f.size() == 3)
          sum += cone(f[0], f[1], f[2]);
        else  // a bilinear face is half-way between its two pairs of triangles
          sum +=
              (cone(f[0], f[1], f[2]) + cone(f[0], f[2], f[3]) + cone(f[1], f[2], f[3]) + cone(f[1], f[3], f[0])) / 2;
      }
    for (const Surface& surface : meshed.model.surfaces)
      for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
        const Triangle& v = meshed.model.triangles[t];
        if (surface.region_minus != universe) enclosed[surface.region_minus] += cone(v[0], v[1], v[2]);
        if (surface.region_plus != universe) enclosed[surface.region_plus] -= cone(v[0], v[1], v[2]);
      }
    for (std::size_t r = 0; r < cells.size(); ++r) {
      EXPECT_GT(enclosed[r], 0);
      EXPECT_NEAR(cells[r], enclosed[r], 1e-9 * enclosed[r]) << meshed.name << " " << r;
    }
  }
}

TEST(HybridRules, H5_regions_change_at_surfaces_only) {
  for (const MeshedModel& meshed : meshed_models()) {
    const VolumeMesh& mesh = meshed.hybrid.mesh;
    std::map<Cycle, std::set<std::uint32_t>> beside;
    for (const Surface& surface : meshed.model.surfaces)
      for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
        const Triangle& v = meshed.model.triangles[t];
        beside[canonical({v[0], v[1], v[2]})] = {surface.region_minus, surface.region_plus};
      }
    std::size_t across = 0;
    for (const auto& [face, cells] : cells_by_face(mesh)) {
      if (cells.size() != 2) continue;
      const auto first = static_cast<std::uint32_t>(mesh.cell_region[cells[0]]);
      const auto second = static_cast<std::uint32_t>(mesh.cell_region[cells[1]]);
      const auto surface = beside.find(face);
      if (surface != beside.end()) {
        ASSERT_EQ(surface->second, (std::set<std::uint32_t>{first, second})) << meshed.name;
      }
      if (first == second) continue;
      ++across;
      ASSERT_NE(surface, beside.end()) << meshed.name;
    }
    EXPECT_EQ(across > 0, meshed.model.regions.size() > 1) << meshed.name;
  }
}

TEST(HybridRules, H6_vertices_edges_and_faces_obey_the_counting_law) {
  for (const MeshedModel& meshed : meshed_models()) {
    const VolumeMesh& mesh = meshed.hybrid.mesh;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const std::vector<Cycle> faces = faces_of(mesh, c);
      std::set<std::uint32_t> vertices;
      std::map<std::array<std::uint32_t, 2>, std::vector<std::size_t>> faces_at;
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < faces[f].size(); ++k) {
          const std::uint32_t a = faces[f][k], b = faces[f][(k + 1) % faces[f].size()];
          vertices.insert(a);
          faces_at[{std::min(a, b), std::max(a, b)}].push_back(f);
        }
      std::set<std::vector<std::size_t>> pairs;
      for (const auto& [edge, at] : faces_at) {
        ASSERT_EQ(at.size(), 2u);
        ASSERT_TRUE(pairs.insert(at).second) << "two faces share two edges";
      }
      const std::size_t v = vertices.size(), e = faces_at.size(), f = faces.size();
      const std::size_t two_points = v - 4, doubled = f - 4;  // V = 4 + c2, E = 6 + c2 + d, F = 4 + d
      ASSERT_EQ(e, 6 + two_points + doubled) << meshed.name;
      ASSERT_GE(2 * e, 3 * v);
      ASSERT_GE(2 * e, 3 * f);
    }
  }
}

TEST(HybridRules, H7_what_was_no_cell_is_told_by_cause) {
  std::uint64_t repaired = 0;
  for (const MeshedModel& meshed : meshed_models()) {
    const HybridReport& report = meshed.hybrid.report;
    const VertexDualCounts& duals = report.vertex_duals;
    const DroppedPairs& dropped = report.dropped;
    EXPECT_EQ(duals.flat + duals.crossing + duals.replaced + duals.kept, duals.candidates) << meshed.name;
    EXPECT_LE(dropped.isolated + dropped.inverted + dropped.nonconforming + dropped.crossing + dropped.unfilled,
              report.facing.pairs);
    EXPECT_EQ(duals.inconsistent_edges, 0u) << meshed.name;
    EXPECT_EQ(duals.unreached, 0u) << meshed.name;
    EXPECT_EQ(report.cells_from_segments + report.cells_from_vertices + report.cells_from_fill,
              meshed.hybrid.mesh.cell_count());
    EXPECT_GT(report.cells_from_voronoi(), report.cells_from_fill) << meshed.name;
    repaired += duals.flat + duals.crossing + duals.replaced + report.facing.turned + report.facing.inverted;
    RecordProperty(meshed.name + "_vertex_cells_flat_before_repair", static_cast<int>(duals.flat));
    RecordProperty(meshed.name + "_vertex_cells_crossed_before_repair", static_cast<int>(duals.crossing));
    RecordProperty(meshed.name + "_vertex_cells_replaced_before_repair", static_cast<int>(duals.replaced));
  }
  EXPECT_GT(repaired, 0u);
}

TEST(HybridRules, H8_every_added_vertex_is_counted_by_cause) {
  std::uint64_t inside = 0;
  for (const MeshedModel& meshed : meshed_models()) {
    const HybridReport& report = meshed.hybrid.report;
    EXPECT_EQ(report.surface_points, meshed.model.points.size());
    EXPECT_EQ(report.surface_points + report.layer_points + report.centre_points + report.apex_points +
                  report.interior_sites + report.fill_points,
              meshed.hybrid.mesh.points.size())
        << meshed.name;
    EXPECT_LE(report.interior_sites, report.interior_sites_asked) << meshed.name;
    std::vector<char> is_used(meshed.hybrid.mesh.points.size(), 0);
    for (const std::uint32_t v : meshed.hybrid.mesh.cell_vertices) is_used[v] = 1;
    EXPECT_EQ(std::count(is_used.begin(), is_used.end(), 0), 0) << meshed.name;
    inside += report.interior_sites;
  }
  EXPECT_GT(inside, 50u);
}

}  // namespace
}  // namespace strataflow
