#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/voronoi/site_neighbours.h"
#include "model/restricted_diagram.h"
#include "model/vector3.h"

namespace strataflow {

/// The part of a triangle that is nearer to `site` than to any other: a convex polygon, turning like the triangle.
struct TrianglePiece {
  std::uint32_t site = 0;
  std::span<const Vec3> points;
  std::span<const PieceEdge> edges;  ///< edges[i] goes from points[i] to the next
};

/// The site nearest to x, ties broken as in bisector_side. The nearer `hint` is, the sooner it is found.
std::uint32_t find_nearest_site(const SiteNeighbours& neighbours, const Vec3& x, std::uint32_t hint);

/// Cuts triangles into the pieces of Voronoi cells (pellerin2014 §2.3). A piece is known by the labels of its edges;
/// its corners are intersections of two of them, so every decision "is this corner nearer to that site" is taken on
/// the triangle's own corners and sites, exactly, ties broken symbolically: the pieces of a triangle tile it, and
/// triangles that share an edge cut it alike. A corner's position is computed from the same numbers in the same
/// order in every piece and triangle that has it, so equal corners are equal bit for bit. Scratch memory: one per thread
/// of work, used for many triangles.
class TriangleCells {
 public:
  explicit TriangleCells(const SiteNeighbours& neighbours) : neighbours_(neighbours) {}

  /// Finds all pieces of a triangle. `start` must be the site nearest to the first corner. Pieces come in an order that
  /// depends on the sites and the triangle alone.
  void cut(const std::array<Vec3, 3>& corners, std::uint32_t start);

  std::size_t piece_count() const { return pieces_.size(); }
  TrianglePiece piece(std::size_t index) const {
    const Piece& piece = pieces_[index];
    return {piece.site, {points_.data() + piece.first, piece.count}, {edges_.data() + piece.first, piece.count}};
  }

 private:
  struct Piece {
    std::uint32_t site, first, count;
  };
  /// A site with what it says about the triangle, as seen from the owner of the piece being cut.
  struct Bisector {
    std::uint32_t site;
    std::array<double, 3> distance;  ///< squared, of the site to the three corners
    std::array<double, 3> value;     ///< how much farther the site is than the owner: the bisector is where it is 0
    double error;                    ///< bound on the rounding of any value
    double largest;                  ///< |value|
  };
  /// Corner of the piece, between edges `before` and `after`: triangle edges 0–2, or 3 + index of a bisector.
  struct Corner {
    std::array<double, 3> weight;  ///< barycentric, not normalised, none negative but for rounding
    double error, largest;         ///< bounds of weight
    std::uint32_t before, after;
  };

  void cut_piece(std::uint32_t owner);
  bool clip(std::uint32_t site);
  Corner make_corner(std::uint32_t before, std::uint32_t after) const;
  bool is_nearer_to_owner(const Corner& corner, const Bisector& other) const;
  bool decide_exactly(const Corner& corner, const Bisector& other) const;
  Vec3 position(const Corner& corner) const;
  double reach() const;  ///< of the owner to the piece's farthest point
  bool has_edge_with(std::uint32_t site) const;

  const SiteNeighbours& neighbours_;
  std::array<Vec3, 3> corners_{};
  std::uint32_t owner_ = 0;
  std::array<double, 3> owner_distance_{};
  std::vector<Bisector> bisectors_;
  std::vector<Corner> polygon_, clipped_;
  std::vector<char> keep_;
  std::vector<std::uint32_t> queue_;
  std::vector<NearSite> beyond_;
  std::vector<Piece> pieces_;
  std::vector<Vec3> points_;
  std::vector<PieceEdge> edges_;
};

}  // namespace strataflow
