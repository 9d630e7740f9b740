#include "stages/remove_scars_stage.h"

#include <algorithm>
#include <array>
#include <string>

#include "kernels/scars/remove_scars.h"

namespace strataflow {

namespace {

void warn_of(const HealedSoup& healed, StageContext& context) {
  const ScarReport& report = healed.report;
  const ErasureReport& erasure = report.erasure;
  if (report.sewn_edges > 0 || !erasure.erased.empty())
    context.warn("scar_removed", "sewed " + std::to_string(report.sewn_edges) + " edges and erased " +
                                     std::to_string(erasure.erased.size()) + " nodes, " +
                                     std::to_string(erasure.delaunay_fills) + " of them by a Delaunay filling");
  constexpr std::array<std::string_view, 4> lip_texts{"folded too much", "with opposite normals",
                                                      "whose partner fits another better",
                                                      "beside an edge that stays open"};
  std::array<std::uint64_t, 4> lips{};
  for (const RefusedLip& lip : report.refused_lips) ++lips[static_cast<std::size_t>(lip.reason)];
  for (std::size_t i = 0; i < lips.size(); ++i)
    if (lips[i] > 0)
      context.warn("scar_kept", std::to_string(lips[i]) + " lips of slits stay open: " + std::string(lip_texts[i]));
  constexpr std::array<std::string_view, 5> node_texts{"on a border", "where another surface is attached",
                                                       "whose surroundings cannot be filled upright",
                                                       "whose filling would repeat an edge", "that no cut inserted"};
  std::array<std::uint64_t, 5> nodes{};
  for (const RefusedErasure& node : erasure.refused) ++nodes[static_cast<std::size_t>(node.reason)];
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] > 0)
      context.warn("scar_node_kept", std::to_string(nodes[i]) + " nodes of scars stay: " + std::string(node_texts[i]));
}

}  // namespace

Result<InputData> RemoveScars::operator()(const InputData& input, StageContext& context) const {
  InputData data = input;
  if (!options.remove_scars) return data;
  ScarMarks marks;
  auto& properties = data.surfaces.properties;
  const auto mark = std::find_if(properties.begin(), properties.end(),
                                 [](const PointProperty& p) { return p.name == "inserted_by_cut" && p.width == 1; });
  if (mark != properties.end()) {
    for (const double value : mark->values) marks.inserted_by_cut.push_back(value > 0.5);
    properties.erase(mark);
  }
  RemoveScarsOptions local;
  local.keep_original_nodes = options.keep_original_nodes;
  Result<HealedSoup> healed = remove_scars(data.surfaces, marks, local);
  if (!healed) return healed.failure();
  warn_of(*healed, context);
  data.surfaces = std::move(healed->soup);
  return data;
}

}  // namespace strataflow
