#include "kernels/voronoi/cvt_volume_energy.h"

#include <algorithm>
#include <cmath>

#include "graph/parallel/parallel_map.h"
#include "kernels/voronoi/cvt_share.h"
#include "kernels/voronoi/restricted_diagram.h"
#include "kernels/voronoi/tetrahedron_cells.h"

namespace strataflow {

namespace {

/// Of a tetrahedron given by its corners relative to the site, with its sign.
void add_tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double density, CvtShare& share) {
  const double volume = density * (dot(b - a, cross(c - a, d - a)) / 6);
  const Vec3 sum = a + b + c + d;
  share.mass += volume;
  share.moment = share.moment + (volume / 4) * sum;
  // volume / 10 · (Σ u_i·u_i + Σ_{i<j} u_i·u_j)
  share.energy += volume / 20 * (dot(a, a) + dot(b, b) + dot(c, c) + dot(d, d) + dot(sum, sum));
}

}  // namespace

void CvtVolumeEnergy::evaluate(const std::vector<Vec3>& sites, bool, CvtTerms& terms) {
  neighbours_.move_to(sites);
  find_owners(points_, neighbours_, owners_);
  constexpr std::size_t grain = 16;
  const std::size_t count = tetrahedra_.size();
  const auto chunks = parallel_map((count + grain - 1) / grain, [&](std::size_t chunk) {
    std::vector<CvtShare> shares;
    TetrahedronCells cells(neighbours_);
    const std::size_t end = std::min(count, (chunk + 1) * grain);
    for (std::size_t t = chunk * grain; t < end; ++t) {
      const Tetrahedron& tet = tetrahedra_[t];
      const std::array<Vec3, 4> corners{points_[tet[0]], points_[tet[1]], points_[tet[2]], points_[tet[3]]};
      const std::uint32_t owner = owners_[tet[0]];
      const double density = density_.empty() ? 1 : density_[t];
      if (owner == owners_[tet[1]] && owner == owners_[tet[2]] && owner == owners_[tet[3]]) {  // cells are convex
        shares.push_back({owner, 0, 0, {}});
        const Vec3& site = sites[owner];
        add_tetrahedron(corners[0] - site, corners[1] - site, corners[2] - site, corners[3] - site, density,
                        shares.back());
        continue;
      }
      cells.cut(corners, owner);
      for (std::size_t i = 0; i < cells.piece_count(); ++i) {
        const TetrahedronPiece piece = cells.piece(i);
        shares.push_back({piece.site, 0, 0, {}});
        const Vec3& site = sites[piece.site];
        const Vec3 apex = piece.points[0] - site;
        for (const PieceFace& face : piece.faces) {
          const auto ring = piece.rings.subspan(face.first, face.count);
          const Vec3 first = piece.points[ring[0]] - site;
          for (std::size_t k = 2; k < ring.size(); ++k)
            add_tetrahedron(apex, first, piece.points[ring[k - 1]] - site, piece.points[ring[k]] - site, density,
                            shares.back());
        }
      }
    }
    return shares;
  });
  sum_shares(chunks, sites, terms);
}

TetrahedralBox tetrahedral_box(const Vec3& low, const Vec3& high, std::size_t blocks) {
  const Vec3 size = high - low;
  const double block = std::max({size.x, size.y, size.z}) / static_cast<double>(std::max<std::size_t>(blocks, 1));
  std::array<std::uint32_t, 3> along{};
  for (int axis = 0; axis < 3; ++axis)
    along[static_cast<std::size_t>(axis)] =
        static_cast<std::uint32_t>(std::max<long>(1, block > 0 ? std::lround(size[axis] / block) : 1));
  TetrahedralBox box;
  const auto coordinate = [&](std::uint32_t i, int axis) {
    const std::uint32_t n = along[static_cast<std::size_t>(axis)];
    return i == n ? high[axis] : low[axis] + size[axis] * i / n;
  };
  for (std::uint32_t k = 0; k <= along[2]; ++k)
    for (std::uint32_t j = 0; j <= along[1]; ++j)
      for (std::uint32_t i = 0; i <= along[0]; ++i)
        box.points.push_back({coordinate(i, 0), coordinate(j, 1), coordinate(k, 2)});
  const std::uint32_t row = along[0] + 1, layer = row * (along[1] + 1);
  for (std::uint32_t k = 0; k < along[2]; ++k)
    for (std::uint32_t j = 0; j < along[1]; ++j)
      for (std::uint32_t i = 0; i < along[0]; ++i) {
        const auto corner = [&](std::uint32_t bits) {
          return (k + (bits >> 2)) * layer + (j + ((bits >> 1) & 1)) * row + i + (bits & 1);
        };
        constexpr std::array<std::array<std::uint32_t, 2>, 6> around{{{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}};
        for (const auto& [a, b] : around) box.tetrahedra.push_back({corner(0), corner(a), corner(b), corner(7)});
      }
  return box;
}

}  // namespace strataflow
