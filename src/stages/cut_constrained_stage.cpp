#include "stages/cut_constrained_stage.h"

#include <map>
#include <utility>

#include "kernels/contacts/cut_constrained.h"
#include "kernels/contacts/find_contacts.h"
#include "model/box3.h"

namespace strataflow {

Result<CutResult> CutConstrained::operator()(const InputData& input, const SealingNeed& need,
                                             StageContext& context) const {
  if (!need.is_needed) return CutResult{input.surfaces, {}, {}};
  const TriangleSoup& raw = input.surfaces;
  Box3 box;
  for (const Vec3& p : raw.points) box.take(p);
  const FindContactsOptions search{.distance_m = options.distance_m.value_or(0.01 * box.diagonal_m()),
                                   .facing_deg = options.facing_deg,
                                   .borders = {.stone_angle_deg = options.stone_angle_deg}};
  const Result<FoundContacts> named = name_contacts(raw, options.contacts, search);
  if (!named) return named.failure();
  const FoundContacts contacts = joined(*named, find_contacts(raw, search));
  Result<ConstrainedCut> cut = cut_constrained(raw, contacts.constraints, {.tolerance_m = options.tolerance_m});
  if (!cut) return cut.failure();

  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> widest;  // of each two entities that were joined
  for (std::size_t i = 0; i < contacts.gaps.size(); ++i) {
    for (const std::string& failure : cut->borders[i].failures) context.warn("contact_failed", failure);
    if (!cut->borders[i].failures.empty()) continue;
    const BorderOnSurface& border = contacts.constraints.borders[i];
    const auto [place, is_new] = widest.try_emplace({border.entity, border.controller}, i);
    if (!is_new && contacts.gaps[i].max_gap_m > contacts.gaps[place->second].max_gap_m) place->second = i;
  }
  CutResult output;
  for (const auto& [entities, i] : widest) {
    const Change& made = output.changes.emplace_back(
        Change{"contact_made", describe(raw, contacts.constraints.borders[i], contacts.gaps[i]) + "; led onto it",
               i < named->gaps.size() ? "asked for by name" : "it nearly touched"});
    context.warn(made.kind, made.what + ": " + made.why);
  }
  for (const std::string& failure : cut->failures) context.warn("contact_failed", failure);
  output.soup = std::move(cut->soup);
  return output;
}

}  // namespace strataflow
