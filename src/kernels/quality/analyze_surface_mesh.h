#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/quality/analyze_triangles.h"
#include "model/structural_model.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// The lines along which the same features meet the same number of times.
struct Contact {
  std::string name;           ///< of the features around it, in alphabetic order, one word per border: "F1 | F1 | H2"
  std::uint32_t valence = 0;  ///< triangles around each edge: 1 free border, 2 crease between surfaces, 3, 4 …
  std::uint64_t lines = 0;
  std::uint64_t edges = 0;
  double length_m = 0;
  template <class A>
  void archive(A& a) {
    a(name, valence, lines, edges, length_m);
  }
};

/// Everything there is to say about the surfaces of a model as a mesh (pellerin2014 §2.9).
struct SurfaceMeshReport {
  std::uint64_t corners = 0, lines = 0, surfaces = 0, regions = 0, vertices = 0;
  double diagonal_m = 0;  ///< of the bounding box
  TriangleQualityReport triangles;
  std::vector<Contact> contacts;              ///< by valence, then by name
  std::vector<std::uint64_t> edge_valences;   ///< [k]: edges with k triangles around them, counted in the mesh itself
  template <class A>
  void archive(A& a) {
    a(corners, lines, surfaces, regions, vertices, diagonal_m, triangles, contacts, edge_valences);
  }
};

SurfaceMeshReport analyze_surface_mesh(const StructuralModel& model);

/// Which contacts of `before` are not in `after` ("contact_lost"), which are new ("contact_created"), and which consist
/// of another number of lines ("contact_lines_changed"), by name and valence. Empty: the same set of contacts.
std::vector<Change> contact_changes(const SurfaceMeshReport& before, const SurfaceMeshReport& after);

}  // namespace strataflow
