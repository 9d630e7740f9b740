#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/voronoi/site_neighbours.h"
#include "model/vector3.h"

namespace strataflow {

/// What bounds a piece of a cell on one side: a face of the tetrahedron, or the bisector with another site.
struct PieceFace {
  static constexpr std::uint32_t on_tetrahedron = 0x80000000u;
  std::uint32_t label = 0;  ///< on_tetrahedron | k for the face opposite corner k; else the other site
  std::uint32_t first = 0;  ///< of its corners in the piece's list of rings
  std::uint32_t count = 0;
  bool is_tetrahedron_face() const { return (label & on_tetrahedron) != 0; }
  std::uint32_t tetrahedron_face() const { return label & 3u; }
  std::uint32_t site() const { return label; }
};

/// The part of a tetrahedron that is nearer to `site` than to any other: a convex polyhedron, three faces at a corner.
struct TetrahedronPiece {
  std::uint32_t site = 0;
  std::span<const Vec3> points;
  std::span<const PieceFace> faces;
  std::span<const std::uint32_t> rings;  ///< corners of faces in turn, indices into points, seen anticlockwise from outside
};

/// Cuts tetrahedra into the pieces of Voronoi cells, as TriangleCells does triangles: every corner is known by the
/// three planes that meet there, decisions are exact with symbolic ties, equal corners are equal bit for bit in all
/// pieces and tetrahedra (Lévy and Liu 2010 for the restricted diagram in volumes; ours is by flooding the cells of each
/// tetrahedron by itself). Scratch memory: one per thread of work.
class TetrahedronCells {
 public:
  explicit TetrahedronCells(const SiteNeighbours& neighbours) : neighbours_(neighbours) {}

  /// Corners of positive volume; `start` must be the site nearest to the first corner.
  void cut(const std::array<Vec3, 4>& corners, std::uint32_t start);

  std::size_t piece_count() const { return pieces_.size(); }
  TetrahedronPiece piece(std::size_t index) const;

 private:
  struct Piece {
    std::uint32_t site, first_point, point_count, first_face, face_count, first_ring, ring_count;
  };
  struct Bisector {
    std::uint32_t site;
    std::array<double, 4> value;  ///< how much farther the site is than the owner, squared, at the four corners
    double error, largest;
  };
  /// Where three planes meet: faces 0–3 of the tetrahedron, or 4 + index of a bisector. Planes turn so that each pair
  /// of neighbours on the polyhedron shares two of them in opposite order.
  struct Corner {
    std::array<std::uint32_t, 3> planes;
    std::array<double, 4> weight;  ///< barycentric, not normalised
    double error, largest;
  };

  void cut_piece(std::uint32_t owner);
  bool clip(std::uint32_t site);
  Corner make_corner(const std::array<std::uint32_t, 3>& planes) const;
  bool is_nearer_to_owner(const Corner& corner, const Bisector& other) const;
  Vec3 position(const Corner& corner) const;
  double reach() const;
  bool has_face_with(std::uint32_t site) const;
  void emit();

  const SiteNeighbours& neighbours_;
  std::array<Vec3, 4> corners_{};
  std::uint32_t owner_ = 0;
  std::array<double, 4> owner_distance_{};
  std::vector<Bisector> bisectors_;
  std::vector<Corner> polyhedron_;
  std::vector<char> keep_;
  std::vector<std::array<std::uint32_t, 2>> kept_pairs_, removed_pairs_;
  std::vector<std::uint32_t> queue_;
  std::vector<NearSite> beyond_;
  std::vector<Piece> pieces_;
  std::vector<Vec3> points_;
  std::vector<PieceFace> faces_;
  std::vector<std::uint32_t> rings_;
};

}  // namespace strataflow
