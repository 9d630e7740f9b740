#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/voronoi/site_neighbours.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// A triangle's edge, from corner k to the next, that lies on a line of the model.
struct LineEdge {
  std::uint32_t triangle = 0;
  std::uint32_t edge = 0;
  static constexpr bool is_flat = true;
};

/// What a centroidal Voronoi tessellation is optimised on. The spans must outlive the energy.
struct CvtDomain {
  std::span<const Vec3> points;
  std::span<const Triangle> triangles;
  std::span<const double> density;      ///< per point, positive, linear on triangles; empty: 1 everywhere
  std::span<const LineEdge> line_edges;  ///< each edge of a line once, through any of its triangles
};

struct CvtTerms {
  double quantization = 0;  ///< ∫ ρ |y − site|², m⁴ (pellerin2014 eq 1.6)
  double attraction = 0;    ///< of lines: 2 · Σ area(site, segment)², m⁴ (§4.3.2 with the erratum: a cross product)
  std::vector<Vec3> quantization_gradient;  ///< per site: 2 · mass · (site − centroid)
  std::vector<Vec3> attraction_gradient;
  std::vector<double> energy;   ///< per site: its part of `quantization`
  std::vector<double> mass;     ///< per site: ∫ ρ on its cell; 0 where the cell meets no triangle
  std::vector<Vec3> centroid;   ///< per site; the site itself where mass is 0
};

/// An energy of sites and its gradient: what `optimise_sites` makes small.
class SiteEnergy {
 public:
  virtual ~SiteEnergy() = default;

  /// At least one site. With `with_attraction` the terms of lines are computed too.
  virtual void evaluate(const std::vector<Vec3>& sites, bool with_attraction, CvtTerms& terms) = 0;
  virtual bool has_lines() const { return false; }
  /// Points of the domain, where a site that lost its cell can be planted anew.
  virtual std::span<const Vec3> points() const = 0;
  /// Of the sites last evaluated.
  virtual const SiteNeighbours& neighbours() const = 0;
};

/// Energy of sites whose cells are restricted to triangles, with its exact gradient (pellerin2014 §2.4, 2.5). Sums run
/// in the order of triangles, whatever the threads.
class CvtEnergy : public SiteEnergy {
 public:
  explicit CvtEnergy(const CvtDomain& domain) : domain_(domain) {}

  void evaluate(const std::vector<Vec3>& sites, bool with_attraction, CvtTerms& terms) override;
  bool has_lines() const override { return !domain_.line_edges.empty(); }
  std::span<const Vec3> points() const override { return domain_.points; }
  const SiteNeighbours& neighbours() const override { return neighbours_; }

 private:
  CvtDomain domain_;
  SiteNeighbours neighbours_;
  std::vector<std::uint32_t> owners_;  ///< per point, the last answer
};

}  // namespace strataflow
