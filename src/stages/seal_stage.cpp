#include "stages/seal_stage.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

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
  for (std::size_t i = cut.changes.size(); i < sealed->changes.size(); ++i)
    context.warn(sealed->changes[i].kind, sealed->changes[i].what + ": " + sealed->changes[i].why);

  const std::vector<Leak> leaks = find_leaks(sealed->soup, distance, options.leak_search_ratio * distance);
  std::string named;
  double widest = 0;
  for (const Leak& leak : leaks) {
    context.warn("leak", leak.text);
    named += "\n  " + leak.text;
    widest = std::max(widest, leak.gap_m);
  }
  if (leaks.empty() || options.on_leak == "warn") return sealed;
  const auto name_of = [&](std::uint32_t entity) { return sealed->soup.entities[entity].name; };
  return Failure{FailureCode::invalid_input, "the surfaces leak:" + named,
                 "set seal.distance_m to at least " + readable(widest) + ", or seal.contacts = [\"" +
                     name_of(leaks.front().entity) + " -> " + name_of(leaks.front().onto) + " within " +
                     readable(leaks.front().gap_m) +
                     "\"] and so on, or seal.on_leak = \"warn\" where they are meant to end"};
}

}  // namespace strataflow
