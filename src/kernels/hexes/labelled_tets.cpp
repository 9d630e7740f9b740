#include "kernels/hexes/labelled_tets.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/volumes/tet_faces.h"

namespace strataflow {
namespace {

constexpr double sin_30_deg = 0.5;      // an outer facet leaning less is a side
constexpr double agreeing_ratio = 0.8;  // of a surface's area: then all of it is of that kind

Failure bad_input(std::string what) {
  return {FailureCode::invalid_input, std::move(what), "give tetrahedra that conform to a sealed model"};
}

SheetKind outer_kind(const Vec3& outward) {
  const double up = outward.z / length(outward);
  return up > sin_30_deg ? SheetKind::top : up < -sin_30_deg ? SheetKind::bottom : SheetKind::side;
}

/// Per surface, the kind nearly all of its outer area has.
std::vector<std::optional<SheetKind>> kinds_of_surfaces(const VolumeMesh& mesh) {
  std::vector<std::array<double, 3>> area(mesh.surface_entity.size(), {0, 0, 0});
  const auto index = [](SheetKind kind) { return kind == SheetKind::top ? 0u : kind == SheetKind::bottom ? 1u : 2u; };
  for (const MeshFacet& facet : mesh.facets) {
    if (facet.cell_0 != no_index && facet.cell_1 != no_index) continue;
    Vec3 n = cross(mesh.points[facet.vertices[1]] - mesh.points[facet.vertices[0]],
                   mesh.points[facet.vertices[2]] - mesh.points[facet.vertices[0]]);
    if (facet.cell_0 == no_index) n = -1.0 * n;
    area[facet.surface][index(outer_kind(n))] += length(n);
  }
  std::vector<std::optional<SheetKind>> kinds;
  for (const auto& share : area) {
    const double all = share[0] + share[1] + share[2];
    std::optional<SheetKind> kind;
    for (const SheetKind each : {SheetKind::top, SheetKind::bottom, SheetKind::side})
      if (all > 0 && share[index(each)] >= agreeing_ratio * all) kind = each;
    kinds.push_back(kind);
  }
  return kinds;
}

}  // namespace

Triangle face_vertices(const Tet& tet, std::uint32_t k) {
  const auto& corner = face_corners[k];
  return {tet[corner[0]], tet[corner[1]], tet[corner[2]]};
}

std::vector<std::uint32_t> face_partners(const std::vector<Tet>& tets, std::size_t point_count,
                                         const std::vector<char>& is_wall) {
  std::vector<std::uint32_t> partner(4 * tets.size(), no_index);
  const std::vector<FaceEntry> faces = grouped_faces({}, point_count, tets);
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
    const std::uint32_t a = faces[i].id, b = faces[i + 1].id;
    if (!faces[i].has_same_vertices(faces[i + 1]) || (!is_wall.empty() && (is_wall[a] || is_wall[b]))) continue;
    partner[a] = b;
    partner[b] = a;
  }
  return partner;
}

Result<void> connect_tets(LabelledTets& tets) {
  tets.neighbour.assign(4 * tets.tets.size(), no_index);
  tets.facet_of.assign(4 * tets.tets.size(), no_index);
  std::vector<Triangle> triangles;
  for (const SheetFacet& facet : tets.facets) triangles.push_back(facet.vertices);
  const std::vector<FaceEntry> faces = grouped_faces(triangles, tets.points.size(), tets.tets);
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].has_same_vertices(faces[i])) ++end;
    std::size_t first = i;
    while (first < end && faces[first].is_facet) ++first;
    if (end - first > 2 || end == first || first - i > 1)
      return bad_input("a triangle is shared by " + std::to_string(end - first) + " tetrahedra and " +
                       std::to_string(first - i) + " facets");
    for (std::size_t f = first; f < end; ++f) {
      if (first > i) tets.facet_of[faces[f].id] = faces[i].id;
      if (end - first == 2) tets.neighbour[faces[f].id] = faces[f == first ? first + 1 : first].id;
    }
    i = end;
  }
  for (std::uint32_t face = 0; face < tets.neighbour.size(); ++face)
    if (tets.neighbour[face] == no_index && tets.facet_of[face] == no_index)
      return bad_input("tetrahedron " + std::to_string(face / 4) + " has an outer face on no surface");
  return {};
}

Result<LabelledTets> label_tets(const VolumeMesh& mesh, const std::vector<std::string>& drop_alignment) {
  for (const std::string& name : drop_alignment)
    if (std::none_of(mesh.entities.begin(), mesh.entities.end(), [&](const Entity& e) { return e.name == name; }))
      return Failure{FailureCode::invalid_options, "drop_alignment names '" + name + "', which is no entity",
                     "name a surface of the model"};
  const auto is_dropped = [&](const Entity& entity) {
    return std::find(drop_alignment.begin(), drop_alignment.end(), entity.name) != drop_alignment.end();
  };
  LabelledTets tets;
  tets.local_origin = mesh.local_origin;
  tets.points = mesh.points;
  tets.entities = mesh.entities;
  tets.region_names = mesh.region_names;
  tets.region.assign(mesh.cell_count(), 0);
  if (mesh.cell_count() == 0 || mesh.cell_count() >= no_index / 8) return bad_input("no or too many cells");
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    if (mesh.cell_types[c] != CellType::tetrahedron)
      return bad_input("cell " + std::to_string(c) + " is no tetrahedron");
    const std::uint32_t* v = mesh.cell_vertices.data() + mesh.cell_offsets[c];
    tets.tets.push_back({v[0], v[1], v[2], v[3]});
    for (std::uint32_t k = 0; k < 4; ++k)
      if (v[k] >= mesh.points.size() || !is_finite(mesh.points[v[k]]))
        return bad_input("cell " + std::to_string(c) + " has a vertex that is not there");
    if (orientation_3d(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]) <= 0)
      return bad_input("cell " + std::to_string(c) + " is inverted or flat");
    if (!mesh.cell_region.empty()) tets.region[c] = mesh.cell_region[c];
  }
  const auto kind_of_surface = kinds_of_surfaces(mesh);
  for (const MeshFacet& facet : mesh.facets) {
    const auto entity = static_cast<std::uint32_t>(mesh.surface_entity[facet.surface]);
    if (entity >= mesh.entities.size()) return bad_input("a facet lies on a surface of no entity");
    SheetFacet sheet;
    sheet.vertices = {facet.vertices[0], facet.vertices[1], facet.vertices[2]};
    sheet.entity = entity;
    if (facet.cell_0 == no_index || facet.cell_1 == no_index) {
      Vec3 n = cross(mesh.points[sheet.vertices[1]] - mesh.points[sheet.vertices[0]],
                     mesh.points[sheet.vertices[2]] - mesh.points[sheet.vertices[0]]);
      if (facet.cell_0 == no_index) n = -1.0 * n;
      sheet.kind = kind_of_surface[facet.surface].value_or(outer_kind(n));
    } else {
      const Entity& named = mesh.entities[entity];
      const bool is_fault = named.role == Role::fault;
      if (is_dropped(named) && !is_fault) continue;
      if (named.role == Role::intrusion)
        return Failure{FailureCode::unsupported, named.name + " is an intrusion, which layers cannot pass through",
                       "leave it out with drop_alignment = [\"" + named.name + "\"]"};
      if (!is_fault && named.role != Role::horizon && named.role != Role::unconformity)
        return bad_input(named.name + " has no role that tells whether it is a fault or a horizon");
      sheet.kind = is_fault ? SheetKind::fault : SheetKind::horizon;
      sheet.is_aligned = is_fault && is_dropped(named) ? 0 : 1;
    }
    tets.facets.push_back(sheet);
  }
  if (const Result<void> connected = connect_tets(tets); !connected) return connected.failure();
  return tets;
}

}  // namespace strataflow
