#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/volumes/region_mesh.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// What a face of the tetrahedra is to the hexahedra.
enum class SheetKind : std::uint8_t { horizon, fault, side, top, bottom };

struct SheetFacet {
  Triangle vertices{};
  std::uint32_t entity = 0;  ///< index into LabelledTets::entities
  SheetKind kind = SheetKind::horizon;
  std::uint8_t is_aligned = 1;  ///< hexahedra follow it; 0: only the layers do (`drop_alignment`)
  std::array<std::uint8_t, 2> zero{};
  static constexpr bool is_flat = true;
};

/// The input of hexahedra (coudert2024 S8): tetrahedra that conform to labelled triangles. Face 4·t + k of tetrahedron
/// t is opposite to its vertex k.
struct LabelledTets {
  Vec3 local_origin;
  std::vector<Vec3> points;
  std::vector<Tet> tets;               ///< positive
  std::vector<std::int32_t> region;    ///< per tet
  std::vector<std::uint32_t> neighbour;  ///< per face: the face that touches it, no_index outside
  std::vector<std::uint32_t> facet_of;   ///< per face: index into facets, or no_index
  std::vector<SheetFacet> facets;
  std::vector<Entity> entities;
  std::vector<std::string> region_names;
  template <class A>
  void archive(A& a) {
    a(local_origin, points, tets, region, neighbour, facet_of, facets, entities, region_names);
  }

  bool has(std::uint32_t face, SheetKind kind) const {
    return facet_of[face] != no_index && facets[facet_of[face]].kind == kind;
  }
  /// Whether columns of hexahedra must follow the face.
  bool is_wall(std::uint32_t face) const {
    return (has(face, SheetKind::fault) && facets[facet_of[face]].is_aligned != 0) || has(face, SheetKind::side);
  }
};

/// Reads the tetrahedra of a model. Outer facets are top, bottom or side by their normals, one kind for all of a
/// surface where nearly all of it agrees; inner ones by their roles. Faults called in `drop_alignment` displace layers
/// but need not be followed; other surfaces called there count as if they were not. Fails with: invalid_options (a
/// name that is no entity), invalid_input (not tetrahedra, not conforming, a role that says nothing), unsupported (an
/// intrusion, which cannot be extruded).
Result<LabelledTets> label_tets(const VolumeMesh& mesh, const std::vector<std::string>& drop_alignment = {});

/// Finds `neighbour` and `facet_of` from tets and facets. Fails with invalid_input where more than two tetrahedra share
/// a face, or a facet is a face of none.
Result<void> connect_tets(LabelledTets& tets);

/// Partners of faces with the same three vertices, no_index for those without. Faces of which `is_wall` (per face; may
/// be empty) says so have none.
std::vector<std::uint32_t> face_partners(const std::vector<Tet>& tets, std::size_t point_count,
                                         const std::vector<char>& is_wall);

/// The three corners of a face, counter-clockwise seen from outside its tetrahedron.
Triangle face_vertices(const Tet& tet, std::uint32_t k);

}  // namespace strataflow
