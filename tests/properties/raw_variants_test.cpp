// Surfaces as interpreters deliver them, stopping short or overshooting, in any order, turn and place: sealed to the
// same regions as the sealed originals, or refused with the leak's name. Never silently another model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/option_field.h"
#include "graph/parallel/parallel_map.h"
#include "io/input/local_origin.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/sealing/seal_surfaces.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"
#include "properties/rotation.h"
#include "stages/check_validity_stage.h"
#include "stages/cut_constrained_stage.h"
#include "stages/cut_stage.h"
#include "stages/judge_surfaces_stage.h"
#include "stages/seal_stage.h"
#include "support/faulted_box.h"
#include "support/sanitized.h"
#include "support/shuffled.h"

namespace strataflow {
namespace {

// ---- what a model is, whatever its numbers and place

struct RegionFacts {
  std::set<std::string> entities;  ///< around it
  double volume_m3 = 0;
  double frontier_m2 = 0;
};

struct ModelFacts {
  std::vector<RegionFacts> regions;            ///< by entities, then volume
  std::map<std::string, double> dangling_m2;   ///< per entity with surfaces that end inside a region
  std::set<std::string> names;                 ///< of entities with a surface
};

constexpr double least_face_m2 = 1e-3;  ///< smaller ones are what rounding leaves of a point where surfaces meet

void sort_regions(std::vector<RegionFacts>& regions) {
  std::sort(regions.begin(), regions.end(), [](const RegionFacts& a, const RegionFacts& b) {
    return a.entities != b.entities ? a.entities < b.entities : a.volume_m3 < b.volume_m3;
  });
}

ModelFacts facts_of(const StructuralModel& model) {
  ModelFacts facts;
  for (const Region& region : model.regions) facts.regions.push_back({{}, region.volume_m3, 0});
  for (const Surface& surface : model.surfaces) {
    double area_m2 = 0;
    for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
      const Triangle& v = model.triangles[t];
      area_m2 += 0.5 * length(cross(model.points[v[1]] - model.points[v[0]], model.points[v[2]] - model.points[v[0]]));
    }
    for (const std::uint32_t e : surface.all_entities) facts.names.insert(model.entities[e].name);
    if (surface.is_dangling()) {
      facts.dangling_m2[model.entities[surface.entity].name] += area_m2;
      continue;
    }
    for (const std::uint32_t region : {surface.region_plus, surface.region_minus}) {
      if (region == universe) continue;
      facts.regions[region].frontier_m2 += area_m2;
      if (area_m2 < least_face_m2) continue;
      for (const std::uint32_t e : surface.all_entities) facts.regions[region].entities.insert(model.entities[e].name);
    }
  }
  sort_regions(facts.regions);
  return facts;
}

// ---- variants

struct Transformation {
  const char* name;
  std::function<TriangleSoup(TriangleSoup)> apply;
};

TriangleSoup moved(TriangleSoup soup, const std::function<Vec3(const Vec3&)>& place) {
  for (Vec3& p : soup.points) p = place(p);
  return soup;
}

const std::vector<Transformation>& transformations() {
  static const std::vector<Transformation> all{
      {"as it is", [](TriangleSoup soup) { return soup; }},
      {"shuffled", [](const TriangleSoup& soup) { return support::shuffled(soup, 11); }},
      {"turned about z", [](TriangleSoup soup) { return moved(std::move(soup), support::about_z); }},
      {"turned about a skew axis",
       [](TriangleSoup soup) { return moved(std::move(soup), support::Rotation({1, -2, 3}, 30)); }},
      {"5000 km away",
       [](TriangleSoup soup) { return moved(std::move(soup), [](const Vec3& p) { return p + Vec3{5e6, 5e6, 0}; }); }}};
  return all;
}

/// What should touch what, and the extent that a raw ratio is a share of, at most, metres.
struct TouchingEntities {
  std::string from, onto;
  double extent_m;
};

/// A model that exists raw, and what it should become.
struct Original {
  std::string name;
  std::function<TriangleSoup(double ratio)> raw;
  ModelFacts sealed;
  double volume_m3 = 0;
  std::vector<TouchingEntities> contacts;
  bool has_known_volumes = false;  ///< the raw surfaces are the same flat pieces: errors come from the gaps alone
};

struct Variant {
  const Original* original = nullptr;
  double ratio = 0;
  std::size_t transformation = 0;
  bool names_contacts = false;
  std::string text() const {
    return original->name + (names_contacts ? ", contacts named" : "") + ", ratio " + OptionPrinter::literal(ratio) +
           ", " + transformations()[transformation].name;
  }
};

struct Outcome {
  char mark = 'W';                ///< o: sealed alike, L: refused, naming the leak, R: refused, W: wrong
  std::string why;
  double volume_error_ratio = 0;  ///< the worst of all regions
  double shift_m = 0;             ///< the worst difference of volumes by frontier area
};

bool is_box_side(const std::string& name) {
  static const std::set<std::string> sides{"Top", "Bottom", "North", "South", "East", "West"};
  return sides.find(name) != sides.end();
}

/// "H1 -> F1 within 60" for every pair of words of the lists. What sticks out of the box is cut off without naming.
std::vector<std::string> contact_texts(const Original& original, double ratio) {
  std::vector<std::string> texts;
  for (const TouchingEntities& contact : original.contacts) {
    std::istringstream froms(contact.from);
    for (std::string from; froms >> from;) {
      std::istringstream ontos(contact.onto);
      for (std::string onto; ontos >> onto;)
        if (ratio > 0 || !is_box_side(onto)) texts.push_back(from + " -> " + onto + " within " +
                        OptionPrinter::literal(1.05 * std::abs(ratio) * contact.extent_m));
    }
  }
  return texts;
}

/// The way of a job from its input to the checked model, stage by stage.
Result<BuiltModel> sealed(const TriangleSoup& raw, const std::vector<std::string>& contacts) {
  StageContext context("test");
  InputData input;
  input.surfaces = raw;
  shift_to_local_origin(input);
  const Result<SealingNeed> need = JudgeSurfaces{}(input, context);
  if (!need) return need.failure();
  CutConstrained join;
  Seal seal;
  join.options.contacts = seal.options.contacts = contacts;
  const Result<CutResult> joined = join(input, *need, context);
  if (!joined) return joined.failure();
  const Result<CutResult> cut = Cut{}(*joined, *need, context);
  if (!cut) return cut.failure();
  const Result<CutResult> closed = seal(*cut, *need, context);
  if (!closed) return closed.failure();
  return build_structural_model(closed->soup);
}

/// What differs from the sealed original; nothing if it is the same model.
std::string difference(const Original& original, const ModelFacts& facts, double ratio, double distance_m,
                       Outcome& outcome) {
  const ModelFacts& wanted = original.sealed;
  std::string text;
  if (facts.names != wanted.names) text += "; names differ";
  if (facts.regions.size() != wanted.regions.size())
    return text + "; " + std::to_string(facts.regions.size()) + " regions, not " +
           std::to_string(wanted.regions.size());
  double sum = 0;
  for (std::size_t r = 0; r < wanted.regions.size(); ++r) {
    const RegionFacts &is = facts.regions[r], &should = wanted.regions[r];
    if (is.entities != should.entities) {
      text += "; a region between";
      for (const std::string& name : is.entities) text += " " + name;
      text += " instead of";
      for (const std::string& name : should.entities) text += " " + name;
    }
    const double error_m3 = std::abs(is.volume_m3 - should.volume_m3);
    outcome.volume_error_ratio = std::max(outcome.volume_error_ratio, error_m3 / should.volume_m3);
    outcome.shift_m = std::max(outcome.shift_m, error_m3 / is.frontier_m2);
    const double most_m3 = original.has_known_volumes ? (std::abs(ratio) + 1e-9) * should.volume_m3
                                                      : 0.1 * distance_m * is.frontier_m2;
    if (!(error_m3 <= most_m3))
      text += "; volume " + OptionPrinter::literal(is.volume_m3) + " m3 instead of " +
              OptionPrinter::literal(should.volume_m3);
    sum += is.volume_m3;
  }
  if (!(std::abs(sum / original.volume_m3 - 1) <= 1e-6)) text += "; the box is not full";
  for (const auto& [name, area_m2] : wanted.dangling_m2)
    if (const auto is = facts.dangling_m2.find(name); is == facts.dangling_m2.end())
      text += "; " + name + " dies nowhere";
    else if (!(is->second >= 0.9 * area_m2))
      text += "; " + name + " dies on " + OptionPrinter::literal(is->second) + " m2 instead of " +
              OptionPrinter::literal(area_m2);
  for (const auto& [name, area_m2] : facts.dangling_m2)
    if (wanted.dangling_m2.find(name) == wanted.dangling_m2.end()) text += "; " + name + " hangs free";
  return text;
}

Outcome outcome_of(const Variant& variant) {
  const Original& original = *variant.original;
  const TriangleSoup raw = transformations()[variant.transformation].apply(original.raw(variant.ratio));
  std::vector<std::string> contacts;
  double distance_m = sealing_distance_m(raw, {});
  if (variant.names_contacts) {
    contacts = contact_texts(original, variant.ratio);
    for (const TouchingEntities& contact : original.contacts)
      distance_m = std::max(distance_m, std::abs(variant.ratio) * contact.extent_m);
  }
  Outcome outcome;
  const Result<BuiltModel> built = sealed(raw, contacts);
  if (!built) {
    const auto says = [&](const char* text) { return built.failure().what.find(text) != std::string::npos; };
    outcome.mark = says("the surfaces leak:") || says("in doubt:") ? 'L' : 'R';
    outcome.why = built.failure().what;
    return outcome;
  }
  const ValidityReport report = check_validity(*built);
  if (const std::optional<Failure> failure = why_not_sealed(built->model, report)) {
    outcome.mark = 'R';
    outcome.why = failure->what;
    return outcome;
  }
  if (report.intersecting_triangle_pairs != 0) outcome.why = "; triangles cross";
  outcome.why += difference(original, facts_of(built->model), variant.ratio, distance_m, outcome);
  if (outcome.why.empty()) outcome.mark = 'o';
  return outcome;
}

// ---- the models

Original reference_model(const std::string& name, double resolution_m, std::vector<TouchingEntities> contacts) {
  const Result<TriangleSoup> soup = generate_reference_model(name, {.resolution_m = resolution_m});
  EXPECT_TRUE(soup) << describe(soup.failure());
  const Result<BuiltModel> built = build_structural_model(*soup);
  EXPECT_TRUE(built);
  Original original{name,
                    [name, resolution_m](double ratio) {
                      return *generate_reference_model(name, {.resolution_m = resolution_m, .raw_ratio = ratio});
                    },
                    facts_of(built->model),
                    name == "D" ? 120.0 * 120 * 120 : 1600.0 * 930 * 500,
                    std::move(contacts)};
  return original;
}

std::vector<Original> reference_models() {
  const std::string horizons = "H1 H2 H3", strike = "North South", across = "East West", ends = "Top Bottom";
  return {
      reference_model("A1", 150, {{horizons, strike, 930}, {horizons, across, 1600}}),
      reference_model("A2", 150,
                      {{horizons, strike, 930},
                       {horizons, across + " F1 F2", 800},
                       {"F1 F2", strike, 930},
                       {"F1 F2", ends, 500}}),
      reference_model("A3", 150, {{horizons, strike, 930}, {horizons, across + " F1 F2", 800}}),
      reference_model("A4", 150,
                      {{horizons, strike, 930},
                       {horizons, across + " F1 F2", 800},
                       {"F1", "North", 930},
                       {"F2", strike, 930},
                       {"F1 F2", ends, 500}}),
      reference_model("A5", 150,
                      {{horizons, strike, 930},
                       {horizons, across + " F1 F2", 1200},
                       {"F1", strike, 930},
                       {"F2", "North", 930},
                       {"F1 F2", ends, 500}}),
      reference_model("A6", 80,
                      {{horizons + " E", strike, 930},
                       {horizons + " E", across, 1600},
                       {"H1 H2", "F1 F2", 800},
                       {"F1", "North", 930},
                       {"F2", strike, 930}}),
      reference_model("B", 150,
                      {{horizons, strike, 930},
                       {"H1 H2", across, 1100},
                       {"H3", across + " F1", 1100},
                       {"F1", strike, 930}}),
      reference_model("C", 150, {{"U H1 H2", strike, 930}, {"U H2", across, 1600}, {"H1", "West", 1600}}),
      reference_model("D", 12,
                      {{horizons, strike + " " + across, 60}, {"H1 H2", "Diapir", 66}, {"Diapir", "Bottom", 60}})};
}

Original faulted_box(std::uint32_t faults) {
  const support::FaultedBox box(faults);
  Original original;
  original.name = "box, " + std::to_string(faults) + " faults";
  original.raw = [box](double ratio) { return box.raw_surfaces(ratio); };
  for (const support::FaultedBox::KnownRegion& region : box.regions()) {
    original.sealed.regions.push_back({region.entities, region.volume_m3, 0});
    original.sealed.names.insert(region.entities.begin(), region.entities.end());
    original.volume_m3 += region.volume_m3;
  }
  sort_regions(original.sealed.regions);
  original.has_known_volumes = true;
  std::string all_faults;
  for (std::uint32_t f = 1; f <= faults; ++f) all_faults += " F" + std::to_string(f);
  original.contacts = {{"H1 H2 H3", "North South", 600},
                       {"H1 H2 H3", "West East" + all_faults, 450},
                       {all_faults, "North South", 600},
                       {all_faults, "Top Bottom", 500}};
  return original;
}

// ---- the table

constexpr double automatic_ratios[] = {1e-6, -1e-6, 1e-4, -1e-4, 1e-3, -1e-3, 3e-3, -3e-3, 1e-2, -1e-2};
constexpr double named_ratios[] = {0.03, 0.05};

struct Tally {
  std::map<char, std::size_t> count;
  double volume_error_ratio = 0, shift_m = 0;
  std::size_t sum() const {
    std::size_t sum = 0;
    for (const auto& [mark, n] : count) sum += n;
    return sum;
  }
};

/// Runs all variants and prints a row per model: per ratio a mark for each transformation.
Tally run_and_print(std::vector<Variant> variants) {
  if (support::sanitized) {  // too slow for all: one in ten
    std::vector<Variant> some;
    for (std::size_t i = 0; i < variants.size(); i += 10) some.push_back(variants[i]);
    variants = some;
  }
  const ScheduleScope scope(ScheduleKind::threads);
  const std::vector<Outcome> outcomes =
      parallel_map(variants.size(), [&](std::size_t i) { return outcome_of(variants[i]); });
  Tally tally;
  std::vector<const Original*> originals;
  std::map<double, bool> ratios;
  std::map<const Original*, std::map<double, std::string>> cells;
  std::map<const Original*, std::pair<double, double>> worst;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const Variant& variant = variants[i];
    const Outcome& outcome = outcomes[i];
    ++tally.count[outcome.mark];
    if (cells.find(variant.original) == cells.end()) originals.push_back(variant.original);
    std::string& cell = cells[variant.original][variant.ratio];
    cell.resize(transformations().size(), '.');
    cell[variant.transformation] = outcome.mark;
    ratios[variant.ratio] = true;
    if (outcome.mark != 'o') continue;
    auto& [error_ratio, shift_m] = worst[variant.original];
    error_ratio = std::max(error_ratio, outcome.volume_error_ratio);
    shift_m = std::max(shift_m, outcome.shift_m);
  }
  std::printf("%-15s", "raw ratio");
  for (const auto& [ratio, is_used] : ratios) std::printf(" %6g", ratio);
  std::printf("  worst volume error, shift\n");
  for (const Original* original : originals) {
    std::printf("%-15s", original->name.c_str());
    for (const auto& [ratio, is_used] : ratios) {
      const auto cell = cells[original].find(ratio);
      std::printf(" %6s", cell == cells[original].end() ? "" : cell->second.c_str());
    }
    std::printf("  %8.2g  %8.2g m\n", worst[original].first, worst[original].second);
  }
  std::printf("Marks in the order");
  for (const Transformation& transformation : transformations()) std::printf(" '%s'", transformation.name);
  std::printf(": o sealed alike, L leak named, R refused, W wrong, . not run\n%zu variants: %zu alike, %zu leaks named,"
              " %zu refused, %zu WRONG\n",
              tally.sum(), tally.count['o'], tally.count['L'], tally.count['R'], tally.count['W']);
  for (std::size_t i = 0; i < variants.size(); ++i)
    if (outcomes[i].mark != 'o')
      std::printf("%c %s: %s\n", outcomes[i].mark, variants[i].text().c_str(), outcomes[i].why.c_str());
  return tally;
}

TEST(RawVariants, are_sealed_like_the_sealed_originals) {
  std::vector<Original> originals = reference_models();
  for (std::uint32_t faults = 0; faults <= 12; ++faults) originals.push_back(faulted_box(faults));
  std::vector<Variant> variants;
  std::size_t turn = 0;
  for (const Original& original : originals) {
    const bool is_large = original.name == "A6" || original.has_known_volumes;
    const auto add = [&](double ratio, bool names_contacts) {
      const bool is_in_all_ways =
          !is_large && !names_contacts && std::abs(ratio) != 1e-4 && std::abs(ratio) != 3e-3;
      ++turn;  // the others are transformed one way each, in turns
      for (std::size_t t = 0; t < transformations().size(); ++t)
        if (is_in_all_ways || t == turn % transformations().size())
          variants.push_back({&original, ratio, t, names_contacts});
    };
    for (const double ratio : automatic_ratios) add(ratio, false);
    for (const double ratio : named_ratios)  // at 5 % two of A6's caps of H3 are gone from the raw surfaces
      if (original.name != "A6" || ratio < 0.05) add(ratio, true);
  }
  Tally tally = run_and_print(variants);
  EXPECT_GE(tally.sum(), support::sanitized ? 20u : 200u);
  EXPECT_EQ(tally.count['W'], 0u);
  EXPECT_EQ(tally.count['R'], 0u);
  // Under sanitizers so few are run that one leak named is more than two in a hundred.
  if (!support::sanitized) { EXPECT_GE(static_cast<double>(tally.count['o']), 0.98 * static_cast<double>(tally.sum())); }
}

TEST(RawVariants, that_stop_short_by_more_than_the_sealing_distance_are_sealed_or_refused_by_name) {
  const std::vector<Original> originals = reference_models();
  std::vector<Variant> variants;
  for (const Original& original : originals)
    for (const double ratio : {0.02, 0.03, 0.05}) variants.push_back({&original, ratio, 0, false});
  Tally tally = run_and_print(variants);
  EXPECT_EQ(tally.count['W'], 0u);
  EXPECT_EQ(tally.count['R'], 0u);
  if (!support::sanitized) { EXPECT_GT(tally.count['L'], 0u); }
}

/// Every one sealed alike or refused by name.
void expect_none_silently_wrong(const std::vector<Variant>& variants, std::size_t least_alike) {
  Tally tally = run_and_print(variants);
  EXPECT_EQ(tally.count['W'], 0u);
  EXPECT_EQ(tally.count['R'], 0u);
  if (!support::sanitized) { EXPECT_GE(tally.count['o'], least_alike); }
}

TEST(RawVariants, that_overshoot_by_more_than_the_sealing_distance_are_sealed_or_refused_by_name) {
  std::vector<Original> originals = reference_models();
  for (std::uint32_t faults = 0; faults <= 12; ++faults) originals.push_back(faulted_box(faults));
  for (const bool names_contacts : {true, false}) {
    std::vector<Variant> variants;
    for (const Original& original : originals)
      for (const double ratio : {-0.03, -0.05})
        if (original.name != "A6") variants.push_back({&original, ratio, 0, names_contacts});
    expect_none_silently_wrong(variants, names_contacts ? 42 : 38);
  }
}

// An unconformity that grazes a horizon: with smaller triangles than an overshoot is long, contacts fold.
TEST(RawVariants, of_a_grazing_unconformity_in_finer_meshes_are_sealed_or_refused_by_name) {
  const std::vector<TouchingEntities> contacts = reference_models()[5].contacts;
  std::vector<Original> originals;
  for (const double resolution_m : {60, 30, 25}) originals.push_back(reference_model("A6", resolution_m, contacts));
  std::vector<Variant> variants;
  for (const Original& original : originals)
    for (const double ratio : {0.01, -0.01})
      for (const std::size_t transformation : {0, 2}) variants.push_back({&original, ratio, transformation, false});
  expect_none_silently_wrong(variants, 0);
}

}  // namespace
}  // namespace strataflow
