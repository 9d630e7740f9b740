#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernels/adapters/tetgen/tetgen_exchange.h"
#include "kernels/volumes/region_boundary.h"
#include "kernels/volumes/region_mesh.h"
#include "kernels/volumes/tetrahedralize_model.h"

namespace strataflow {

/// One way to ask TetGen for the same region. It is a heuristic program: an input it fails on in one order or
/// orientation often works in another. All of these are exactly undone.
struct RegionAttempt {
  std::string switches;          ///< without quality and size, which are appended
  bool is_stretched = false;     ///< z is multiplied by vertical_stretch()
  bool has_turned_axes = false;  ///< x, y, z are sent as y, z, x
  bool has_reversed_points = false;
  bool has_reversed_facets = false;
  friend bool operator==(const RegionAttempt&, const RegionAttempt&) = default;
};

/// The power of two by which z is best multiplied: with it the triangles of the surfaces are closest to equilateral on
/// average. Models drawn with vertical exaggeration have needles for triangles in true space; stretched, more of them
/// are Delaunay, and TetGen has less to recover (a third of the time on such models). 1 for well-shaped surfaces.
double vertical_stretch(const RegionBoundary& boundary);

/// In words, for reports.
std::string describe(const RegionAttempt& attempt);

/// The attempts that keep every surface as it is, in the order they are made.
std::vector<RegionAttempt> attempts_keeping_surfaces();
/// The attempts after which points on surfaces are accepted, gentlest first.
std::vector<RegionAttempt> attempts_splitting_surfaces();

/// What to ask of TetGen besides conforming, as switches: dihedral angles. Volumes and ratios are ours to refine for:
/// with its surfaces kept, TetGen gives up near them, which on coarse surfaces is everywhere.
std::string interior_switches(const TetrahedralizeOptions& options);

/// How coordinates are sent: shifted to the box centre along every axis where that loses no bit, stretched, turned.
class RegionFrame {
 public:
  RegionFrame(const RegionBoundary& boundary, const RegionAttempt& attempt);
  Vec3 sent(const Vec3& p) const;
  Vec3 restored(const Vec3& p) const;

 private:
  Vec3 centre_;
  double stretch_ = 1;
  bool has_turned_axes_ = false;
};

TetgenRequest request_for(const RegionBoundary& boundary, const RegionAttempt& attempt, const RegionFrame& frame,
                          const std::string& interior, std::uint64_t memory_limit_mb);

/// TetGen's answer in the boundary's own numbers: the boundary's points with their exact coordinates, then TetGen's.
struct RegionAnswer {
  std::vector<Vec3> points;
  std::vector<Tet> tets;
  std::vector<Triangle> subfaces;
  std::vector<std::uint32_t> subface_facet;
};

RegionAnswer answer_from(const RegionBoundary& boundary, const RegionAttempt& attempt, const RegionFrame& frame,
                         TetgenResponse response);

}  // namespace strataflow
