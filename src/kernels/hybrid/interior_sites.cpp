#include "kernels/hybrid/interior_sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/seed.h"
#include "kernels/volumes/refine_interior.h"
#include "kernels/voronoi/cvt_volume_energy.h"

namespace strataflow {

namespace {

constexpr double volume_of_edge = 0.7;  ///< a cell's volume over its edge's third power

/// Per point the mean length of edges: at the boundary of those of its facets, inside of the boundary's points that
/// share a tetrahedron with it.
std::vector<double> edge_lengths(const RegionBoundary& boundary, const RegionMesh& mesh) {
  const std::size_t own = boundary.coordinates.size(), all = own + mesh.interior_points.size();
  std::vector<double> sum(all, 0), weight(all, 0);
  const auto add = [&](std::uint32_t p, double length_m) {
    sum[p] += length_m;
    weight[p] += 1;
  };
  double total = 0;
  for (const Triangle& facet : boundary.facets)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = facet[k], b = facet[(k + 1) % 3];
      const double edge = length(boundary.coordinates[b] - boundary.coordinates[a]);
      add(a, edge);
      add(b, edge);
      total += edge;
    }
  for (const Tet& tet : mesh.tets)
    for (const std::uint32_t p : tet)
      for (const std::uint32_t q : tet)
        if (p >= own && q < own) add(p, sum[q] / weight[q]);
  const double mean = total / static_cast<double>(3 * boundary.facets.size());
  std::vector<double> edge(all, mean);
  for (std::size_t p = 0; p < all; ++p)
    if (weight[p] > 0) edge[p] = sum[p] / weight[p];
  return edge;
}

/// Sites per volume in each tetrahedron, times its volume.
std::vector<double> shares_of(const std::vector<Vec3>& points, const std::vector<Tet>& tets,
                              const std::vector<double>& edge) {
  std::vector<double> shares;
  shares.reserve(tets.size());
  for (const Tet& tet : tets) {
    double density = 0;
    for (const std::uint32_t p : tet) density += 0.25 / (edge[p] * edge[p] * edge[p]);
    shares.push_back(volume_of(points, tet) * density / volume_of_edge);
  }
  return shares;
}

/// The solid angle at corner k, as a share of the full one.
double angle_share(const std::vector<Vec3>& points, const Tet& tet, std::size_t k) {
  const Vec3& at = points[tet[k]];
  const Vec3 a = points[tet[(k + 1) % 4]] - at, b = points[tet[(k + 2) % 4]] - at, c = points[tet[(k + 3) % 4]] - at;
  const double la = length(a), lb = length(b), lc = length(c);  // van Oosterom and Strackee 1983
  const double angle =
      2 * std::atan2(std::abs(dot(a, cross(b, c))), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  return angle / (4 * std::numbers::pi);
}

}  // namespace

double interior_site_count(const RegionBoundary& boundary, const RegionMesh& mesh) {
  const std::vector<Vec3> points = points_of(boundary, mesh);
  double count = 0;
  for (const double share : shares_of(points, mesh.tets, edge_lengths(boundary, mesh))) count += share;
  for (const Tet& tet : mesh.tets)
    for (std::size_t k = 0; k < 4; ++k)
      if (tet[k] < boundary.coordinates.size()) count -= angle_share(points, tet, k);
  return std::max(count, 0.0);
}

std::vector<Vec3> spread_interior_sites(const RegionBoundary& boundary, const RegionMesh& mesh, std::size_t count,
                                        std::size_t lloyd_iterations, const CancellationToken* cancellation) {
  std::vector<Vec3> sites;
  if (count == 0 || mesh.tets.empty()) return sites;
  std::vector<Vec3> points = points_of(boundary, mesh);
  std::vector<double> edge = edge_lengths(boundary, mesh);
  const std::vector<double> shares = shares_of(points, mesh.tets, edge);

  // One site in each of `count` equal shares, in the order of tetrahedra.
  double total = 0;
  for (const double share : shares) total += share;
  RandomStream random(1);
  std::vector<double> drawn_edge;
  double passed = 0;
  for (std::size_t t = 0; t < mesh.tets.size() && sites.size() < count; ++t) {
    passed += shares[t];
    const auto next = [&] { return total * (static_cast<double>(sites.size()) + 0.5) / static_cast<double>(count); };
    while (sites.size() < count && next() < passed) {
      std::array<double, 3> cuts{random.unit(), random.unit(), random.unit()};
      std::sort(cuts.begin(), cuts.end());  // the gaps between three sorted numbers are uniform in a tetrahedron
      const std::array<double, 4> weight{cuts[0], cuts[1] - cuts[0], cuts[2] - cuts[1], 1 - cuts[2]};
      Vec3 at{};
      double edge_m = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        at = at + weight[k] * points[mesh.tets[t][k]];
        edge_m += weight[k] * edge[mesh.tets[t][k]];
      }
      sites.push_back(at);
      drawn_edge.push_back(edge_m);
    }
  }

  // The domain: tetrahedra about as large as cells, so that each is cut into few pieces.
  RegionMesh fine = mesh;
  for (const std::uint32_t s : insert_interior_points(boundary, fine, sites)) edge.push_back(drawn_edge[s]);
  points = points_of(boundary, fine);
  double mean_edge = 0;
  for (const double edge_m : edge) mean_edge += edge_m / static_cast<double>(edge.size());
  std::vector<double> density;  // the spacing of a tessellation goes with density^(−1/5)
  density.reserve(fine.tets.size());
  for (const Tet& tet : fine.tets) {
    double edge_m = 0;
    for (const std::uint32_t p : tet) edge_m += 0.25 * edge[p];
    density.push_back(std::pow(mean_edge / edge_m, 5));
  }
  CvtVolumeEnergy energy(points, fine.tets, density);
  const std::size_t own = boundary.coordinates.size();
  std::vector<Vec3> all = boundary.coordinates;
  all.insert(all.end(), sites.begin(), sites.end());
  CvtTerms terms;
  for (std::size_t step = 0; step < lloyd_iterations && !(cancellation && cancellation->is_cancelled()); ++step) {
    energy.evaluate(all, false, terms);
    for (std::size_t s = own; s < all.size(); ++s)
      if (terms.mass[s] > 0) all[s] = terms.centroid[s];
  }
  return {all.begin() + static_cast<std::ptrdiff_t>(own), all.end()};
}

}  // namespace strataflow
