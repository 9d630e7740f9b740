#include "kernels/quality/check_mesh_against_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "graph/parallel/ordered_reduce.h"
#include "kernels/quality/match_cell_faces.h"
#include "kernels/quality/measure_cell.h"

namespace strataflow {

namespace {

constexpr double tolerance_ratio = 1e-9;

bool agree(double a, double b) { return std::abs(a - b) <= tolerance_ratio * std::max(std::abs(a), std::abs(b)); }

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.12g", value);
  return buffer;
}

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * length(cross(b - a, c - a)); }

double face_area(const std::vector<Vec3>& points, const std::array<std::uint32_t, 4>& face) {
  const double first = triangle_area(points[face[0]], points[face[1]], points[face[2]]);
  return face[3] == no_index ? first : first + triangle_area(points[face[0]], points[face[2]], points[face[3]]);
}

double add(double a, double b) { return a + b; }

/// [sum of value(i) over the items of group 0, of group 1, …]; items of no group are left out.
template <class GroupOf, class Value>
std::vector<double> sum_by_group(std::size_t count, std::size_t groups, GroupOf&& group_of, Value&& value) {
  std::vector<std::vector<std::uint32_t>> items(groups);
  for (std::uint32_t i = 0; i < count; ++i)
    if (group_of(i) < groups) items[group_of(i)].push_back(i);
  std::vector<double> sums;
  for (const auto& list : items)
    sums.push_back(ordered_reduce(
        list.size(), 0.0, [&](std::size_t i) { return value(list[i]); }, add));
  return sums;
}

Violation violation(std::string kind, std::string what, std::string remedy, std::uint64_t count = 1) {
  return {std::move(kind), Violation::Severity::error, std::move(what), std::move(remedy), {}, count};
}

std::uint32_t region_of(const VolumeMesh& mesh, std::uint32_t cell) {
  if (cell == no_index || cell >= mesh.cell_region.size() || mesh.cell_region[cell] < 0) return universe;
  return static_cast<std::uint32_t>(mesh.cell_region[cell]);
}

void check_regions(const VolumeMesh& mesh, const StructuralModel& model, std::vector<Violation>& violations) {
  const auto volumes = sum_by_group(
      mesh.cell_count(), model.regions.size(), [&](std::uint32_t cell) { return region_of(mesh, cell); },
      [&](std::uint32_t cell) {
        std::array<Vec3, 8> vertices;
        const int count = vertex_count(mesh.cell_types[cell]);
        for (int i = 0; i < count; ++i) vertices[i] = mesh.points[mesh.cell_vertices[mesh.cell_offsets[cell] + i]];
        return cell_volume(mesh.cell_types[cell], std::span<const Vec3>(vertices).first(count));
      });
  for (std::size_t r = 0; r < model.regions.size(); ++r)
    if (!agree(volumes[r], model.regions[r].volume_m3))
      violations.push_back(violation("region_volume_mismatch",
                                     "region " + std::to_string(r) + " (" + model.regions[r].name +
                                         "): its cells have " + text(volumes[r]) + " m3, its surfaces enclose " +
                                         text(model.regions[r].volume_m3) + " m3",
                                     "cells are missing, overlap, or belong to another region"));
  std::uint64_t strays = 0;
  for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell)
    strays += region_of(mesh, cell) >= model.regions.size();
  if (strays > 0)
    violations.push_back(violation("cell_without_region", std::to_string(strays) + " cells name no region of the model",
                                   "give every cell the region it lies in", strays));
}

bool is_face_of(const VolumeMesh& mesh, std::uint32_t cell, std::array<std::uint32_t, 4> facet) {
  if (cell == no_index) return true;
  if (cell >= mesh.cell_count()) return false;
  std::sort(facet.begin(), facet.end());
  const std::uint32_t* vertices = &mesh.cell_vertices[mesh.cell_offsets[cell]];
  for (const LocalFace& local : shape_of(mesh.cell_types[cell]).faces) {
    std::array<std::uint32_t, 4> face;
    for (int i = 0; i < 4; ++i) face[i] = local[i] == no_local_vertex ? no_index : vertices[local[i]];
    std::sort(face.begin(), face.end());
    if (face == facet) return true;
  }
  return false;
}

/// The facet is a face of both its cells, which lie in the two regions beside its surface.
bool is_facet_sound(const VolumeMesh& mesh, const StructuralModel& model, const MeshFacet& facet) {
  if (facet.surface >= model.surfaces.size()) return false;
  if (!is_face_of(mesh, facet.cell_0, facet.vertices) || !is_face_of(mesh, facet.cell_1, facet.vertices)) return false;
  const Surface& surface = model.surfaces[facet.surface];
  return std::minmax({region_of(mesh, facet.cell_0), region_of(mesh, facet.cell_1)}) ==
         std::minmax({surface.region_plus, surface.region_minus});
}

std::vector<double> surface_areas(const StructuralModel& model) {
  std::vector<double> areas;
  for (const Surface& surface : model.surfaces)
    areas.push_back(ordered_reduce(
        surface.end_triangle - surface.first_triangle, 0.0,
        [&](std::size_t i) {
          const auto [a, b, c] = model.triangles[surface.first_triangle + i];
          return triangle_area(model.points[a], model.points[b], model.points[c]);
        },
        add));
  return areas;
}

void check_facets(const VolumeMesh& mesh, const StructuralModel& model, const std::vector<double>& areas,
                  std::vector<Violation>& violations) {
  const auto covered = sum_by_group(
      mesh.facets.size(), model.surfaces.size(), [&](std::uint32_t f) { return mesh.facets[f].surface; },
      [&](std::uint32_t f) { return face_area(mesh.points, mesh.facets[f].vertices); });
  for (std::size_t s = 0; s < areas.size(); ++s)
    if (!agree(covered[s], areas[s]))
      violations.push_back(violation("surface_not_covered",
                                     "surface " + std::to_string(s) + " of " +
                                         model.entities[model.surfaces[s].entity].name + ": mesh faces cover " +
                                         text(covered[s]) + " m2 of its " + text(areas[s]) + " m2",
                                     "the mesh does not conform to this surface"));
  std::uint64_t unsound = 0;
  std::size_t first = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    if (!is_facet_sound(mesh, model, mesh.facets[f]) && unsound++ == 0) first = f;
  if (unsound > 0)
    violations.push_back(violation("facet_mismatch",
                                   std::to_string(unsound) +
                                       " facets are no faces of the cells they name or have them in "
                                       "the wrong regions, the first is facet " +
                                       std::to_string(first),
                                   "rebuild the facets from the cells", unsound));
}

void check_boundary(const VolumeMesh& mesh, const StructuralModel& model, const std::vector<double>& areas,
                    std::vector<Violation>& violations) {
  const std::vector<CellFace> boundary = match_cell_faces(mesh).boundary_faces;
  const double found = ordered_reduce(
      boundary.size(), 0.0, [&](std::size_t i) { return face_area(mesh.points, boundary[i].vertices); }, add);
  double shell = 0;
  for (std::size_t s = 0; s < areas.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    if ((surface.region_plus == universe) != (surface.region_minus == universe)) shell += areas[s];
  }
  if (!agree(found, shell))
    violations.push_back(
        violation("boundary_mismatch",
                  "faces with one cell measure " + text(found) + " m2, the outer shell " + text(shell) + " m2",
                  "neighbouring regions do not share their faces"));
}

}  // namespace

std::vector<Violation> check_mesh_against_model(const VolumeMesh& mesh, const StructuralModel& model) {
  std::vector<Violation> violations;
  const std::vector<double> areas = surface_areas(model);
  check_regions(mesh, model, violations);
  check_facets(mesh, model, areas, violations);
  check_boundary(mesh, model, areas, violations);
  return violations;
}

}  // namespace strataflow
