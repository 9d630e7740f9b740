#include "kernels/volumes/region_mesh.h"

#include <cmath>

#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/volumes/tet_faces.h"
#include "model/volume_mesh.h"

namespace strataflow {

namespace {

constexpr std::uint32_t behind_facet = no_index - 1;  ///< in a neighbour table: the face is a facet
enum class Place : std::uint8_t { unknown, inside, outside };

}  // namespace

std::vector<Vec3> points_of(const RegionBoundary& boundary, const RegionMesh& mesh) {
  std::vector<Vec3> points = boundary.coordinates;
  points.insert(points.end(), mesh.interior_points.begin(), mesh.interior_points.end());
  return points;
}

double volume_of(const std::vector<Vec3>& points, const Tet& tet) {
  const Vec3& a = points[tet[0]];
  return dot(cross(points[tet[1]] - a, points[tet[2]] - a), points[tet[3]] - a) / 6.0;
}

std::variant<RegionMesh, Rejection> verified_region_mesh(const RegionBoundary& boundary,
                                                         const std::vector<Vec3>& points, const std::vector<Tet>& tets,
                                                         double volume_m3) {
  RegionMesh mesh;
  mesh.facet_tets.assign(boundary.facets.size(), {no_index, no_index});
  std::vector<std::uint32_t> neighbour(4 * tets.size(), no_index);
  std::vector<Place> place(tets.size(), Place::unknown);
  std::vector<std::uint32_t> front;
  const auto put = [&](std::uint32_t tet, Place where) {
    if (place[tet] == Place::unknown) front.push_back(tet);
    if (place[tet] != Place::unknown && place[tet] != where) return false;
    place[tet] = where;
    return true;
  };
  const auto leak = [] { return Rejection{"a tetrahedron lies inside and outside the region"}; };

  const std::vector<FaceEntry> faces = grouped_faces(boundary.facets, points.size(), tets);
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].has_same_vertices(faces[i])) ++end;
    const bool has_facet = faces[i].is_facet;
    const std::size_t first = i + (has_facet ? 1 : 0), count = end - first;
    if (count > 0 && faces[first].is_facet) return Rejection{"two triangles of the surfaces coincide"};
    if (count > 2) return Rejection{"more than two tetrahedra meet in a face"};
    if (count == 2 && faces[first].is_even == faces[first + 1].is_even)
      return Rejection{"two tetrahedra lie on the same side of a face"};
    for (std::size_t f = first; f < end; ++f) {
      if (!has_facet) {
        if (count == 2) neighbour[faces[f].id] = faces[f == first ? first + 1 : first].id / 4;
        continue;
      }
      // A face that turns like the facet has its outward normal on the positive side: the tetrahedron is on the other.
      const std::size_t side = faces[f].is_even == faces[i].is_even ? 0 : 1;
      const std::uint32_t tet = faces[f].id / 4;
      const bool is_inside = (boundary.sides[faces[i].id] >> side & 1) != 0;
      neighbour[faces[f].id] = behind_facet;
      if (!put(tet, is_inside ? Place::inside : Place::outside)) return leak();
      if (is_inside) mesh.facet_tets[faces[i].id][side] = tet;
    }
    i = end;
  }
  for (std::size_t f = 0; f < boundary.facets.size(); ++f)
    for (std::size_t side = 0; side < 2; ++side)
      if ((boundary.sides[f] >> side & 1) != 0 && mesh.facet_tets[f][side] == no_index)
        return Rejection{"a triangle of the surfaces is not a face of the tetrahedra"};
  while (!front.empty()) {
    const std::uint32_t tet = front.back();
    front.pop_back();
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t next = neighbour[4 * tet + k];
      if (next == behind_facet) continue;
      if (next == no_index ? place[tet] == Place::inside : !put(next, place[tet])) return leak();
    }
  }

  std::vector<std::uint32_t> new_tet(tets.size(), no_index), new_point(points.size(), no_index);
  const std::size_t boundary_points = boundary.points.size();
  double sum_m3 = 0;
  for (std::uint32_t t = 0; t < tets.size(); ++t) {
    if (place[t] != Place::inside) continue;
    const Tet& tet = tets[t];
    if (orientation_3d(points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]) <= 0)
      return Rejection{"a tetrahedron is flat or inverted"};
    sum_m3 += volume_of(points, tet);
    new_tet[t] = static_cast<std::uint32_t>(mesh.tets.size());
    Tet& renumbered = mesh.tets.emplace_back(tet);
    for (std::uint32_t& vertex : renumbered) {
      if (vertex < boundary_points) continue;
      if (new_point[vertex] == no_index) {
        new_point[vertex] = static_cast<std::uint32_t>(boundary_points + mesh.interior_points.size());
        mesh.interior_points.push_back(points[vertex]);
      }
      vertex = new_point[vertex];
    }
  }
  if (!(std::abs(sum_m3 - volume_m3) <= 1e-9 * std::abs(volume_m3)))
    return Rejection{"the tetrahedra do not add up to the volume of the region"};
  for (auto& sides : mesh.facet_tets)
    for (std::uint32_t& tet : sides)
      if (tet != no_index) tet = new_tet[tet];
  return mesh;
}

}  // namespace strataflow
