#include "kernels/hexes/layered_space.h"

#include <algorithm>

#include "kernels/hexes/plan_lines.h"
#include "kernels/hexes/refine_tets.h"
#include "kernels/hexes/steepen_layers.h"
#include "kernels/hexes/verticalise.h"

namespace strataflow {
namespace {

double six_volumes(const std::vector<Vec3>& p, const Tet& t) {
  return dot(p[t[1]] - p[t[0]], cross(p[t[2]] - p[t[0]], p[t[3]] - p[t[0]]));
}

/// Faults that need not be followed and part the same unit everywhere are as if they were not there: what they cut off
/// may have no level of its own to hang its layers on.
void forget_undisplaced(LabelledTets& tets, const StratigraphicLevels& levels) {
  std::vector<char> is_kept(tets.entities.size(), 0);
  const auto may_go = [&](const SheetFacet& facet) { return facet.kind == SheetKind::fault && facet.is_aligned == 0; };
  for (std::uint32_t face = 0; face < tets.facet_of.size(); ++face) {
    if (tets.facet_of[face] == no_index) continue;
    const SheetFacet& facet = tets.facets[tets.facet_of[face]];
    const std::uint32_t other = tets.neighbour[face];
    if (!may_go(facet) || other == no_index || levels.unit[face / 4] != levels.unit[other / 4])
      is_kept[facet.entity] = 1;
  }
  std::vector<std::uint32_t> number(tets.facets.size(), no_index);
  std::vector<SheetFacet> kept;
  for (std::size_t f = 0; f < tets.facets.size(); ++f) {
    if (!is_kept[tets.facets[f].entity]) continue;
    number[f] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(tets.facets[f]);
  }
  for (std::uint32_t& facet : tets.facet_of)
    if (facet != no_index) facet = number[facet];
  tets.facets = std::move(kept);
}

/// The failure, if too much is flipped.
Result<void> judge_flips(const LayeredSpace& space) {
  constexpr double tolerated_ratio = 1e-4;
  double all = 0, flipped = 0;
  for (const Tet& tet : space.model.tets) all += six_volumes(space.model.points, tet);
  std::vector<double> by_region;
  for (const std::uint32_t t : space.flipped) {
    if (t >= space.layers.model_tets) continue;
    const double volume = six_volumes(space.model.points, space.model.tets[t]);
    const auto region = static_cast<std::size_t>(std::max(0, space.model.region[t]));
    if (by_region.size() <= region) by_region.resize(region + 1, 0);
    by_region[region] += volume;
    flipped += volume;
  }
  if (!(flipped > tolerated_ratio * all)) return {};
  const auto worst = static_cast<std::size_t>(std::max_element(by_region.begin(), by_region.end()) - by_region.begin());
  return Failure{
      FailureCode::geometry_failed,
      std::to_string(space.flipped.size()) + " tetrahedra turn over between the horizons, most of them in " +
          (worst < space.model.region_names.size() ? space.model.region_names[worst]
                                                   : "region " + std::to_string(worst)),
      "build on surfaces with better triangles (output.from = \"surfaces\"), mesh this region finer, or leave out "
      "the horizon that overturns"};
}

}  // namespace

Result<LayeredSpace> build_layered_space(LabelledTets model, StratigraphicLevels levels, std::vector<Vec3> plan,
                                         const LayerOptions& options) {
  constexpr int rounds = 6;
  LayeredSpace space;
  space.model = std::move(model);
  space.levels = std::move(levels);
  space.plan = std::move(plan);
  space.changes = space.levels.changes;
  std::size_t split = 0;
  for (int round = 0;; ++round) {
    Result<StratigraphicTets> layers =
        find_stratigraphic_function(space.model, space.levels, options, round == 0 ? nullptr : &space.layers);
    if (!layers) return layers.failure();
    space.layers = std::move(*layers);
    space.flipped = flipped_in_layers(space.layers, space.plan);
    if (!space.flipped.empty()) {
      const std::size_t solves = round == 0 ? 40 : 8;  // later rounds begin near what they look for
      const Result<std::size_t> steepened = steepen_layers(space.model, space.levels, space.plan, space.layers, solves);
      if (!steepened) return steepened.failure();
      space.flipped = flipped_in_layers(space.layers, space.plan);
    }
    if (space.flipped.empty() || round == rounds) break;
    const std::size_t count = split_flat_diagonals(space.model, space.levels, space.plan, space.layers, space.flipped);
    if (count == 0) break;
    split += count;
    split_level_chords(space.model, space.levels, &space.plan);
  }
  if (split > 0)
    space.changes.push_back({"split_flat_tetrahedra", std::to_string(split) + " edges", "flat between horizons"});
  if (!space.flipped.empty())
    space.changes.push_back(
        {"flat_tetrahedra", std::to_string(space.flipped.size()) + " tetrahedra", "left aside when lifting"});
  if (const Result<void> judged = judge_flips(space); !judged) return judged.failure();
  return space;
}

Result<LayeredSpace> build_layered_space(UprightModel upright, const LayerOptions& options) {
  Result<LayeredSpace> space =
      build_layered_space(std::move(upright.model), std::move(upright.levels), std::move(upright.plan), options);
  if (!space) return space;
  space->lines = std::move(upright.lines);
  space->turned_over_at_first = upright.turned_over_at_first;
  space->untangling_steps = upright.untangling_steps;
  return space;
}

Result<UprightModel> take_model(const VolumeMesh& mesh, const std::vector<std::string>& drop_alignment) {
  Result<LabelledTets> tets = label_tets(mesh, drop_alignment);
  if (!tets) return tets.failure();
  Result<StratigraphicLevels> levels = find_stratigraphic_levels(*tets);
  if (!levels) return levels.failure();
  forget_undisplaced(*tets, *levels);
  split_level_chords(*tets, *levels);
  UprightModel model{std::move(*tets), std::move(*levels), {}, {}, 0, 0};
  model.plan = model.model.points;
  for (Vec3& p : model.plan) p.z = 0;
  return model;
}

Result<UprightModel> make_upright(const VolumeMesh& mesh, const LayeredSpaceOptions& options) {
  Result<UprightModel> made = take_model(mesh, options.drop_alignment);
  if (!made) return made;
  LabelledTets& tets = made->model;
  StratigraphicLevels& levels = made->levels;
  if (!stands_upright(tets)) {
    split_wall_chords(tets, levels);
    split_level_chords(tets, levels);
    separate_walls(tets, levels);
  }
  Result<UprightPlan> upright = verticalise(tets, {options.untangling_steps});
  if (!upright) return upright.failure();
  made->lines = plan_lines(tets, *upright, options.follow_horizon_lines);
  made->plan = std::move(upright->plan);
  made->turned_over_at_first = upright->flipped_by_linear;
  made->untangling_steps = upright->untangling_steps;
  return made;
}

Result<LayeredSpace> make_layered_space(const VolumeMesh& mesh, const LayeredSpaceOptions& options) {
  Result<UprightModel> upright = make_upright(mesh, options);
  if (!upright) return upright.failure();
  return build_layered_space(*std::move(upright), options.layers);
}

}  // namespace strataflow
