#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/cut_result.h"
#include "stages/judge_surfaces_stage.h"

namespace strataflow {

struct SealStageOptions {
  std::optional<double> distance_m;
  std::vector<std::string> contacts;
  bool trim = true;
  bool trim_outside = true;
  std::optional<double> micro_region_volume_m3;
  std::int64_t passes = 6;
  std::string on_leak = "fail";
  double leak_search_ratio = 5;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(distance_m, OptionField{.name = "distance_m",
                                  .description = "Gaps and overshoots up to this are mended; 0: only named contacts; "
                                                 "absent: 1 % of the diagonal of all surfaces",
                                  .minimum = 0});
    visit(contacts,
          OptionField{.name = "contacts",
                      .description = "Contacts to make whatever their gap, each \"H2 -> F3\" (the nearest border of H2 "
                                     "onto F3), \"H2 -> F3 within 25\" (every border within 25 m), \"H2.border 4 -> "
                                     "F3\" or \"H2.stone -> F3.border\" (the end of a slit onto a fault's tip)"});
    visit(trim, OptionField{.name = "trim",
                            .description = "Take away what juts out past contacts by no more than the distance"});
    visit(trim_outside,
          OptionField{.name = "trim_outside", .description = "Take away what lies outside the boundary surfaces"});
    visit(micro_region_volume_m3,
          OptionField{.name = "micro_region_volume_m3",
                      .description = "Regions smaller than this are merged with a neighbour; absent: the cube of a "
                                     "tenth of the distance, and slivers thinner than a twentieth of it",
                      .minimum = 0});
    visit(passes, OptionField{.name = "passes",
                              .description = "Times borders that still stop short are extended and cut again, each "
                                             "time further",
                              .minimum = 0,
                              .maximum = 20});
    visit(on_leak, OptionField{.name = "on_leak",
                               .description = "What a border means that stops short of a surface by more than the "
                                              "distance, all its length, a piece that juts out past a contact, or a "
                                              "sliver that sealing made: fail, or warn and leave it",
                               .words = {"fail", "warn"}});
    visit(leak_search_ratio, OptionField{.name = "leak_search_ratio",
                                         .description = "How far to look for such borders, in sealing distances",
                                         .minimum = 1});
  }
};

/// Trims what juts out of cut surfaces, extends borders that still stop short and cuts again, merges micro-regions
/// (euler1999 §2.11.4). Surfaces that need no sealing pass unchanged. Fails with invalid_input, naming all of it, when
/// a border still stops short of a surface (leaks), or where sealing made or left what nobody can have meant: surfaces
/// that came to lie on each other, juts, slivers (find_doubts).
struct Seal {
  static constexpr std::string_view name = "seal";
  static constexpr int version = 4;
  SealStageOptions options;

  Result<CutResult> operator()(const CutResult& cut, const SealingNeed& need, StageContext& context) const;
};

}  // namespace strataflow
