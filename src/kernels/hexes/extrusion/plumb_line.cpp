#include "kernels/hexes/extrusion/plumb_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/parallel/parallel_map.h"
#include "kernels/volumes/tet_faces.h"

namespace strataflow {
namespace {

constexpr double same_w = 1e-9;  // of a layer

}  // namespace

PlumbLevel PlumbLine::at_level(double w) const {
  double up = pieces_.front().low_z, low = pieces_.back().high_z;  // last height at or below, first at or above
  bool is_in_jump = false;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const PlumbPiece& piece = pieces_[i];
    const auto crossing = [&] {
      const double share = (w - piece.low_w) / (piece.high_w - piece.low_w);
      return piece.low_z + share * (piece.high_z - piece.low_z);
    };
    if (piece.low_w <= w) up = std::max(up, piece.high_w <= w ? piece.high_z : crossing());
    if (piece.high_w >= w) low = std::min(low, piece.low_w >= w ? piece.low_z : crossing());
    if (i > 0) is_in_jump = is_in_jump || (pieces_[i - 1].high_w + same_w < w && w < piece.low_w - same_w);
  }
  if (!(up > low)) return {0.5 * (up + low), is_in_jump};
  // Repeated: what lies between the two crossings falls back at the fault.
  double largest_fall = 0, fault_z = 0.5 * (up + low);
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    const double z = pieces_[i].low_z, fall = pieces_[i - 1].high_w - pieces_[i].low_w;
    if (z < low || z > up || !(fall > largest_fall)) continue;
    largest_fall = fall;
    fault_z = z;
  }
  return {fault_z - low >= up - fault_z ? low : up, false};
}

std::uint32_t PlumbLine::tet_at(double z) const {
  std::uint32_t tet = no_index;
  double least = std::numeric_limits<double>::infinity();
  for (const PlumbPiece& piece : pieces_) {
    const double away = std::max({0.0, piece.low_z - z, z - piece.high_z});
    if (!(away < least)) continue;
    least = away;
    tet = piece.tet;
  }
  return tet;
}

std::vector<PlumbLeap> PlumbLine::dropped_leaps() const {
  std::vector<PlumbLeap> leaps;
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    const PlumbPiece &below = pieces_[i - 1], &above = pieces_[i];
    if ((below.ends_at_dropped || above.starts_at_dropped) && std::abs(above.low_w - below.high_w) > same_w)
      leaps.push_back({below.high_w, above.low_w});
  }
  return leaps;
}

PlumbLines::PlumbLines(const LayeredSpace& space, const std::vector<Vec3>& places)
    : space_(space), places_(places), is_flipped_(space.layers.tets.size(), 0) {
  for (const std::uint32_t t : space.flipped) is_flipped_[t] = 1;
  Box3 all;
  for (const Vec3& p : space.model.points) all.take(p);
  low_z_ = all.low.z;
  high_z_ = all.high.z;
  tree_ = BoundingVolumeTree(parallel_map(
      std::size_t{space.layers.model_tets},
      [&](std::size_t t) {
        Box3 box;
        for (const std::uint32_t copy : space.layers.tets[t]) {
          const std::uint32_t p = space.layers.point[copy];
          box.take(Vec3{places[p].x, places[p].y, space.model.points[p].z});
        }
        return enclosing(box);
      },
      4096));
}

bool PlumbLines::is_dropped(std::uint32_t face) const {
  const std::uint32_t number = space_.model.facet_of[face];
  return number != no_index && space_.model.facets[number].kind == SheetKind::fault &&
         space_.model.facets[number].is_aligned == 0;
}

PlumbLine PlumbLines::at(double x, double y) const {
  constexpr double outside = -1e-12;  // barycentric: lines along edges belong to all tetrahedra there
  std::vector<PlumbPiece> pieces;
  tree_.visit_items(enclosing({{x, y, low_z_}, {x, y, high_z_}}), [&](std::uint32_t t) {
    if (is_flipped_[t]) return;
    const Tet& tet = space_.layers.tets[t];
    PlumbPiece piece{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0, 0, t};
    for (std::uint32_t f = 0; f < 4; ++f) {
      const auto& face = face_corners[f];
      std::array<double, 3> share{};  // times twice the face's area seen from above
      double all = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& a = places_[space_.layers.point[tet[face[(k + 1) % 3]]]];
        const Vec3& b = places_[space_.layers.point[tet[face[(k + 2) % 3]]]];
        share[k] = (a.x - x) * (b.y - y) - (a.y - y) * (b.x - x);
        all += share[k];
      }
      if (all == 0 || std::any_of(share.begin(), share.end(), [&](double s) { return !(s / all >= outside); }))
        continue;
      double z = 0, w = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        z += share[k] / all * space_.model.points[space_.layers.point[tet[face[k]]]].z;
        w += share[k] / all * space_.layers.w[tet[face[k]]];
      }
      if (z < piece.low_z) {
        piece.low_z = z, piece.low_w = w;
        piece.starts_at_dropped = is_dropped(4 * t + f);
      }
      if (z > piece.high_z) {
        piece.high_z = z, piece.high_w = w;
        piece.ends_at_dropped = is_dropped(4 * t + f);
      }
    }
    if (piece.low_z < piece.high_z && piece.low_w <= piece.high_w) pieces.push_back(piece);
  });
  std::sort(pieces.begin(), pieces.end(), [](const PlumbPiece& a, const PlumbPiece& b) {
    return a.low_z != b.low_z ? a.low_z < b.low_z : a.tet < b.tet;
  });
  return PlumbLine(std::move(pieces));
}

}  // namespace strataflow
