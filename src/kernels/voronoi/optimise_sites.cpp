#include "kernels/voronoi/optimise_sites.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/adapters/lbfgs/minimize.h"
#include "kernels/voronoi/restricted_diagram.h"

namespace strataflow {

namespace {

double norm_of(const std::vector<Vec3>& vectors) {
  double sum = 0;
  for (const Vec3& v : vectors) sum += dot(v, v);
  return std::sqrt(sum);
}

/// Moves each site without a cell to the point of the mesh farthest from its owner, in the cells of largest energy.
std::size_t replant_lost_sites(const SiteEnergy& energy, const CvtTerms& terms,
                               const std::vector<char>& fixed, std::vector<Vec3>& sites) {
  std::vector<std::uint32_t> lost;
  for (std::uint32_t i = 0; i < sites.size(); ++i)
    if (!(terms.mass[i] > 0) && (fixed.empty() || !fixed[i])) lost.push_back(i);
  if (lost.empty()) return 0;
  std::vector<std::uint32_t> owners;
  const std::span<const Vec3> points = energy.points();
  find_owners(points, energy.neighbours(), owners);
  struct Place {
    double distance = 0;
    std::uint32_t point = 0;
  };
  std::vector<Place> farthest(sites.size());
  for (std::uint32_t i = 0; i < owners.size(); ++i)
    if (const double d = length(points[i] - sites[owners[i]]); d > farthest[owners[i]].distance)
      farthest[owners[i]] = {d, i};
  std::vector<std::uint32_t> order(sites.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return terms.energy[a] != terms.energy[b] ? terms.energy[a] > terms.energy[b] : a < b;
  });
  std::size_t moved = 0;
  for (const std::uint32_t rich : order) {
    if (moved == lost.size()) break;
    if (farthest[rich].distance > 0) sites[lost[moved++]] = points[farthest[rich].point];
  }
  return moved;
}

}  // namespace

OptimisedSites optimise_sites(const CvtDomain& domain, std::vector<Vec3> sites, const std::vector<char>& fixed,
                              const OptimiseSitesOptions& options) {
  CvtEnergy energy(domain);
  return optimise_sites(energy, std::move(sites), fixed, options);
}

OptimisedSites optimise_sites(SiteEnergy& energy, std::vector<Vec3> sites, const std::vector<char>& fixed,
                              const OptimiseSitesOptions& options) {
  OptimisedSites result;
  if (sites.empty()) {
    result.stopped_by = "no sites";
    return result;
  }
  CvtTerms& terms = result.terms;
  const auto is_fixed = [&](std::size_t i) { return !fixed.empty() && fixed[i]; };
  const bool attracts = energy.has_lines() && options.line_attraction.value_or(1) > 0;

  for (std::size_t step = 0; step < options.lloyd_iterations && !(options.is_cancelled && options.is_cancelled()); ++step) {
    energy.evaluate(sites, false, terms);
    ++result.evaluations;
    result.lloyd_steps.push_back({terms.quantization, 0});
    result.replanted_sites += replant_lost_sites(energy, terms, fixed, sites);
    for (std::size_t i = 0; i < sites.size(); ++i)
      if (terms.mass[i] > 0 && !is_fixed(i)) sites[i] = terms.centroid[i];
  }
  energy.evaluate(sites, attracts, terms);
  ++result.evaluations;
  if (const std::size_t moved = replant_lost_sites(energy, terms, fixed, sites)) {
    result.replanted_sites += moved;
    energy.evaluate(sites, attracts, terms);
    ++result.evaluations;
  }
  double alpha = attracts ? options.line_attraction.value_or(0.5) : 0;
  if (attracts && !options.line_attraction) {
    const double spread = norm_of(terms.quantization_gradient), pull = norm_of(terms.attraction_gradient);
    alpha = spread + pull > 0 ? spread / (spread + pull) : 0;
  }
  result.line_attraction = alpha;

  // Variables: sites in units in which a Lloyd step of a site is its gradient, and the whole first step has length 1.
  const double mean_mass = std::accumulate(terms.mass.begin(), terms.mass.end(), 0.0) / static_cast<double>(sites.size());
  double lloyd_square = 0;
  std::vector<std::uint32_t> free_sites;
  std::vector<double> site_scale;
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    if (is_fixed(i)) continue;
    const double share = terms.mass[i] / mean_mass;
    free_sites.push_back(i);
    site_scale.push_back(1 / std::sqrt(std::clamp(share, 1e-2, 1e2)));
    lloyd_square += share * dot(terms.centroid[i] - sites[i], terms.centroid[i] - sites[i]);
  }
  const double scale = std::sqrt(lloyd_square);
  if (scale > 0 && options.iterations > 0) {
    const double unit = 1 / (2 * mean_mass * scale * scale);
    const std::vector<Vec3> start = sites;
    const auto place = [&](const std::vector<double>& x) {
      for (std::size_t k = 0; k < free_sites.size(); ++k)
        sites[free_sites[k]] = start[free_sites[k]] + scale * site_scale[k] * Vec3{x[3 * k], x[3 * k + 1], x[3 * k + 2]};
    };
    std::vector<double> x(3 * free_sites.size(), 0.0);
    const Objective objective = [&](const std::vector<double>& at, std::vector<double>& gradient) {
      place(at);
      energy.evaluate(sites, attracts, terms);
      for (std::size_t k = 0; k < free_sites.size(); ++k) {
        Vec3 g = (1 - alpha) * terms.quantization_gradient[free_sites[k]];
        if (attracts) g = g + alpha * terms.attraction_gradient[free_sites[k]];
        for (int axis = 0; axis < 3; ++axis)
          gradient[3 * k + static_cast<std::size_t>(axis)] = unit * scale * site_scale[k] * g[axis];
      }
      return unit * ((1 - alpha) * terms.quantization + alpha * terms.attraction);
    };
    const Minimized minimized = minimize(x, objective, {.iterations = options.iterations,
                                                        .gradient_ratio = 1e-9,
                                                        .is_cancelled = options.is_cancelled});
    for (const MinimizeStep& step : minimized.steps)
      result.newton_steps.push_back({step.value / unit, step.gradient_norm / (unit * scale)});
    result.evaluations += minimized.evaluations;
    result.stopped_by = minimized.stopped_by;
    place(x);
  } else {
    result.stopped_by = "nothing to move";
  }
  energy.evaluate(sites, attracts, terms);
  ++result.evaluations;
  result.sites = std::move(sites);
  return result;
}

}  // namespace strataflow
