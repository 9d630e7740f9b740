#include "kernels/sealing/merge_micro_regions.h"

#include <algorithm>
#include <tuple>

#include "base/id.h"
#include "base/option_field.h"
#include "kernels/sealing/without_surfaces.h"
#include "kernels/topology/building/build_structural_model.h"

namespace strataflow {

namespace {

/// Lower goes first.
int rank_of(Role role) {
  switch (role) {
    case Role::fault:
      return 2;
    case Role::intrusion:
      return 1;
    default:
      return 0;
  }
}

/// The surface to delete so that a region joins a neighbour, or no_index.
std::uint32_t choose_surface(const StructuralModel& model, std::uint32_t region) {
  std::uint32_t best = no_index;
  std::tuple<int, double> best_key;
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    if ((surface.region_plus == region) == (surface.region_minus == region)) continue;
    int rank = 0;
    bool is_boundary = surface.region_plus == universe || surface.region_minus == universe;
    for (const std::uint32_t e : surface.all_entities) {
      is_boundary = is_boundary || model.entities[e].role == Role::boundary;
      rank = std::max(rank, rank_of(model.entities[e].role));
    }
    if (is_boundary) continue;
    const std::tuple<int, double> key{rank, -area_m2(model, surface)};
    if (best != no_index && !(key < best_key)) continue;
    best = s;
    best_key = key;
  }
  return best;
}

}  // namespace

Result<MergedRegions> merge_micro_regions(const TriangleSoup& soup, const MicroRegions& micro) {
  MergedRegions result;
  result.soup = soup;
  while (!result.soup.triangles.empty()) {
    const Result<BuiltModel> built = build_structural_model(result.soup);
    if (!built) return built.failure();
    const StructuralModel& model = built->model;
    // Every region that is small now; several may join the same one in a turn, but none that is itself joining another.
    std::vector<std::uint32_t> small;
    std::vector<double> frontier_area(model.regions.size(), 0);
    double whole = 0;
    for (const Surface& surface : model.surfaces)
      for (const std::uint32_t r : {surface.region_plus, surface.region_minus})
        if (r != universe && !surface.is_dangling()) frontier_area[r] += area_m2(model, surface);
    for (const Region& region : model.regions) whole += region.volume_m3;
    for (std::uint32_t r = 0; r < model.regions.size(); ++r) {
      const double volume = model.regions[r].volume_m3;
      const bool is_sliver =
          volume < micro.sliver_volume_ratio * whole && volume < 0.5 * micro.sliver_thickness_m * frontier_area[r];
      if (volume < micro.volume_m3 || is_sliver) small.push_back(r);
    }
    std::sort(small.begin(), small.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(model.regions[a].volume_m3, a) < std::pair(model.regions[b].volume_m3, b);
    });
    std::vector<char> goes(model.regions.size(), 0), grows(model.regions.size(), 0);
    std::vector<std::uint32_t> doomed;
    for (const std::uint32_t r : small) {
      if (grows[r]) continue;
      const std::uint32_t s = choose_surface(model, r);
      if (s == no_index) continue;
      const Surface& surface = model.surfaces[s];
      const std::uint32_t other = surface.region_plus == r ? surface.region_minus : surface.region_plus;
      if (goes[other]) continue;
      goes[r] = grows[other] = 1;
      doomed.push_back(s);
      result.changes.push_back({"merged_micro_region",
                                "a region of " + OptionPrinter::literal(model.regions[r].volume_m3) + " m3 beside '" +
                                    model.entities[surface.entity].name + "'",
                                "too small to mean anything"});
    }
    if (doomed.empty()) break;
    result.soup = without_surfaces(result.soup, model, doomed);
  }
  return result;
}

}  // namespace strataflow
