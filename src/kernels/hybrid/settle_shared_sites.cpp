#include "kernels/hybrid/settle_shared_sites.h"

#include <algorithm>
#include <cmath>

#include "kernels/remeshing/dual/cell_components.h"
#include "kernels/voronoi/restricted_diagram.h"

namespace strataflow {

namespace {

constexpr double stiffness = 4;       ///< > 2.4: holds sheets up to 1.5 edges apart
constexpr double least_cosine = 0.7;  ///< between sheets that face each other
constexpr double least_share = 0.1;   ///< of the largest sheet in the cell: smaller ones are crumbs

}  // namespace

void HeldEnergy::evaluate(const std::vector<Vec3>& sites, bool with_attraction, CvtTerms& terms) {
  energy_.evaluate(sites, with_attraction, terms);
  if (held_mass_.empty()) held_mass_ = terms.mass;
  for (std::size_t i = 0; i < holds_.size(); ++i) {
    const Vec3& n = holds_[i].normal;
    if (dot(n, n) == 0) continue;
    const double away = dot(sites[i] - holds_[i].middle, n), weight = stiffness * held_mass_[i];
    terms.quantization += weight * away * away;
    terms.energy[i] += weight * away * away;
    terms.quantization_gradient[i] = terms.quantization_gradient[i] + 2 * weight * away * n;
    terms.centroid[i] = terms.centroid[i] - dot(terms.centroid[i] - holds_[i].middle, n) * n;
  }
}

Result<std::vector<SheetHold>> find_sheet_holds(const StructuralModel& model, const std::vector<Vec3>& sites,
                                                const std::vector<std::vector<std::uint32_t>>& stacks) {
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  const RestrictedDiagram diagram = restrict_to_triangles(model.points, model.triangles, neighbours);
  const Result<CellComponents> components = find_cell_components(model, diagram, sites.size());
  if (!components) return components.failure();
  struct Sheet {
    Vec3 area, moment;
    double size = 0;
  };
  std::vector<Sheet> sheets(components->surfaces.size());
  for (std::size_t i = 0; i < diagram.piece_count(); ++i) {
    Sheet& sheet = sheets[components->piece_component[i]];
    const Vec3& site = sites[diagram.piece_site[i]];
    const auto corners = diagram.piece_points(i);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const Vec3 a = corners[0] - site, b = corners[k] - site, c = corners[k + 1] - site;
      const Vec3 area = 0.5 * cross(b - a, c - a);
      const double size = length(area);
      sheet.area = sheet.area + area;
      sheet.moment = sheet.moment + (size / 3) * (a + b + c);
      sheet.size += size;
    }
  }
  std::vector<SheetHold> holds(sites.size());
  for (std::uint32_t s = 0; s < sites.size(); ++s) {
    const std::uint32_t first = components->site_surfaces[s], end = components->site_surfaces[s + 1];
    const auto is_in_stack = [&](std::uint32_t c) {
      return std::binary_search(stacks[s].begin(), stacks[s].end(), components->surfaces[c].surface);
    };
    std::uint32_t largest = no_index;
    for (std::uint32_t c = first; c < end; ++c)
      if (is_in_stack(c) && (largest == no_index || sheets[c].size > sheets[largest].size)) largest = c;
    if (largest == no_index) continue;
    const double size = length(sheets[largest].area);
    if (!(size > 0)) continue;
    const Vec3 normal = (1 / size) * sheets[largest].area;
    double low = 0, high = 0;
    bool is_first = true;
    std::uint32_t facing = 0;
    for (std::uint32_t c = first; c < end; ++c) {
      if (!is_in_stack(c) || !(sheets[c].size > least_share * sheets[largest].size)) continue;
      if (!(std::abs(dot(sheets[c].area, normal)) > least_cosine * length(sheets[c].area))) continue;
      const double at = dot(sheets[c].moment, normal) / sheets[c].size;
      low = is_first ? at : std::min(low, at);
      high = is_first ? at : std::max(high, at);
      is_first = false;
      ++facing;
    }
    if (facing >= 2) holds[s] = {sites[s] + 0.5 * (low + high) * normal, normal};
  }
  return holds;
}

Result<OptimisedSites> settle_shared_sites(const StructuralModel& model, const CvtDomain& domain,
                                           const SharedSites& shared, const SettleOptions& options) {
  OptimisedSites settled;
  settled.sites = shared.sites;
  std::vector<char> fixed = shared.is_pinned;
  if (!fixed.empty()) fixed.resize(shared.sites.size(), 0);
  for (std::size_t round = 0; round < std::max<std::size_t>(options.rounds, 1); ++round) {
    Result<std::vector<SheetHold>> holds = find_sheet_holds(model, settled.sites, shared.stacks);
    if (!holds) return holds.failure();
    HeldEnergy energy(domain, std::move(*holds));
    OptimisedSites next = optimise_sites(energy, std::move(settled.sites), fixed, options.optimise);
    next.evaluations += settled.evaluations;
    next.replanted_sites += settled.replanted_sites;
    next.lloyd_steps.insert(next.lloyd_steps.begin(), settled.lloyd_steps.begin(), settled.lloyd_steps.end());
    next.newton_steps.insert(next.newton_steps.begin(), settled.newton_steps.begin(), settled.newton_steps.end());
    settled = std::move(next);
    if (options.optimise.is_cancelled && options.optimise.is_cancelled()) break;
  }
  return settled;
}

}  // namespace strataflow
