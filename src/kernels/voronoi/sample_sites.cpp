#include "kernels/voronoi/sample_sites.h"

#include <cmath>

#include "base/seed.h"

namespace strataflow {

std::vector<Vec3> sample_sites(std::span<const Vec3> points, std::span<const Triangle> triangles,
                               std::span<const double> density, std::size_t count, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<double> weight_until;  // Σ of density · area up to and with each triangle
  weight_until.reserve(triangles.size());
  double total = 0;
  for (const auto& [a, b, c] : triangles) {
    const double area = 0.5 * length(cross(points[b] - points[a], points[c] - points[a]));
    total += area * (density.empty() ? 1 : (density[a] + density[b] + density[c]) / 3);
    weight_until.push_back(total);
  }
  std::vector<Vec3> sites;
  if (!(total > 0)) return sites;
  sites.reserve(count);
  std::size_t t = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double target = total * ((static_cast<double>(i) + random.unit()) / static_cast<double>(count));
    while (t + 1 < triangles.size() && weight_until[t] <= target) ++t;
    const auto& [a, b, c] = triangles[t];
    const double root = std::sqrt(random.unit()), other = random.unit();
    sites.push_back(points[a] + root * (1 - other) * (points[b] - points[a]) + root * other * (points[c] - points[a]));
  }
  return sites;
}

}  // namespace strataflow
