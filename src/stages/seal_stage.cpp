#include "stages/seal_stage.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "kernels/sealing/find_doubts.h"
#include "kernels/sealing/find_leaks.h"
#include "kernels/sealing/seal_surfaces.h"

namespace strataflow {

namespace {

/// A distance to set: three digits, rounded up.
std::string readable(double metres) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::max(metres, 1e-9))) - 2);
  std::ostringstream text;
  text << std::setprecision(6) << std::ceil(metres / unit) * unit;
  return text.str();
}

}  // namespace

Result<CutResult> Seal::operator()(const CutResult& cut, const SealingNeed& need, StageContext& context) const {
  if (!need.is_needed) return cut;
  SealSurfacesOptions sealing{.distance_m = options.distance_m,
                              .contacts = options.contacts,
                              .trim = options.trim,
                              .trim_outside = options.trim_outside,
                              .micro_region_volume_m3 = options.micro_region_volume_m3,
                              .passes = static_cast<int>(options.passes)};
  const double distance = sealing_distance_m(cut.soup, sealing);
  Result<CutResult> sealed = seal_cut_surfaces(cut, {}, sealing);
  if (!sealed) return sealed;
  std::vector<Doubt> doubts;
  for (std::size_t i = cut.changes.size(); i < sealed->changes.size(); ++i) {
    const Change& change = sealed->changes[i];
    context.warn(change.kind, change.what + ": " + change.why);
    if (change.kind == "coincident_patches")
      doubts.push_back({change.what + " since sealing moved their borders",
                        "cut back what overshoots there, or name the contacts they should end on"});
  }
  const std::vector<Leak> leaks = find_leaks(sealed->soup, distance, options.leak_search_ratio * distance);
  const Result<std::vector<Doubt>> found =
      find_doubts(sealed->soup, distance, contacts_with_distance(options.contacts));
  if (!found) return found.failure();
  doubts.insert(doubts.end(), found->begin(), found->end());
  std::string named, doubted;
  double widest = 0;
  for (const Leak& leak : leaks) {
    context.warn("leak", leak.text);
    named += "\n  " + leak.text;
    widest = std::max(widest, leak.gap_m);
  }
  for (const Doubt& doubt : doubts) {
    context.warn("doubt", doubt.text);
    doubted += "\n  " + doubt.text;
  }
  if ((leaks.empty() && doubts.empty()) || options.on_leak == "warn") return sealed;
  const std::string meant = ", or seal.on_leak = \"warn\" where that is meant";
  if (leaks.empty())
    return Failure{FailureCode::invalid_input, "sealed, but in doubt:" + doubted, doubts.front().remedy + meant};
  const auto name_of = [&](std::uint32_t entity) { return sealed->soup.entities[entity].name; };
  return Failure{FailureCode::invalid_input,
                 "the surfaces leak:" + named + (doubts.empty() ? "" : "\nand are in doubt:" + doubted),
                 "set seal.distance_m to at least " + readable(widest) + ", or seal.contacts = [\"" +
                     name_of(leaks.front().entity) + " -> " + name_of(leaks.front().onto) + " within " +
                     readable(leaks.front().gap_m) + "\"] and so on" + meant};
}

}  // namespace strataflow
