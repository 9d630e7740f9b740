#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/voronoi/cvt_energy.h"

namespace strataflow {

using Tetrahedron = std::array<std::uint32_t, 4>;

/// Energy of sites whose cells are restricted to tetrahedra of positive volume (pellerin2014 §2.4): ∫ ρ |y − site|²
/// over the volume, m⁵, with its exact gradient. ρ: `density` of each tetrahedron, positive; empty: 1 everywhere. Sums
/// run in the order of tetrahedra, whatever the threads. The spans must outlive it.
class CvtVolumeEnergy : public SiteEnergy {
 public:
  CvtVolumeEnergy(std::span<const Vec3> points, std::span<const Tetrahedron> tetrahedra,
                  std::span<const double> density = {})
      : points_(points), tetrahedra_(tetrahedra), density_(density), neighbours_(SiteNeighbours::in_volumes) {}

  void evaluate(const std::vector<Vec3>& sites, bool with_attraction, CvtTerms& terms) override;
  std::span<const Vec3> points() const override { return points_; }
  const SiteNeighbours& neighbours() const override { return neighbours_; }

 private:
  std::span<const Vec3> points_;
  std::span<const Tetrahedron> tetrahedra_;
  std::span<const double> density_;
  SiteNeighbours neighbours_;
  std::vector<std::uint32_t> owners_;  ///< per point, the last answer
};

/// A box in blocks of six tetrahedra each, `blocks` along its longest side, as cube-like as that allows.
struct TetrahedralBox {
  std::vector<Vec3> points;
  std::vector<Tetrahedron> tetrahedra;
};
TetrahedralBox tetrahedral_box(const Vec3& low, const Vec3& high, std::size_t blocks);

}  // namespace strataflow
