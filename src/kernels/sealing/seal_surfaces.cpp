#include "kernels/sealing/seal_surfaces.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>

#include "base/option_field.h"
#include "kernels/contacts/cut_constrained.h"
#include "kernels/contacts/find_contacts.h"
#include "kernels/sealing/extend_borders.h"
#include "kernels/sealing/merge_micro_regions.h"
#include "kernels/sealing/trim_outside.h"
#include "kernels/sealing/trim_overshoot.h"
#include "model/box3.h"

namespace strataflow {

namespace {

std::string metres(double value) { return OptionPrinter::literal(value) + " m"; }

/// One change per entity for all pieces of it.
void tell_trimmed(const TriangleSoup& soup, const std::vector<TrimmedPiece>& pieces, const char* kind, const char* why,
                  std::vector<Change>& changes) {
  std::map<std::uint32_t, std::pair<std::uint64_t, double>> by_entity;
  for (const TrimmedPiece& piece : pieces) {
    ++by_entity[piece.entity].first;
    by_entity[piece.entity].second += piece.area_m2;
  }
  for (const auto& [entity, sum] : by_entity)
    changes.push_back({kind,
                       std::to_string(sum.first) + " pieces of '" + soup.entities[entity].name + "', " +
                           OptionPrinter::literal(sum.second) + " m2",
                       why});
}

Box3 box_of(const TriangleSoup& soup) {
  Box3 box;
  for (const Triangle& t : soup.triangles)
    for (const std::uint32_t v : t) box.take(soup.points[v]);
  return box;
}

std::uint64_t edge_count(const std::vector<BorderGap>& gaps) {
  std::uint64_t count = 0;
  for (const BorderGap& gap : gaps) count += gap.edge_count;
  return count;
}

void add(CutReport& sum, const CutReport& more) {
  if (sum.rounds == 0) sum.intersecting_pairs = more.intersecting_pairs;
  sum.cut_triangles += more.cut_triangles;
  sum.new_points += more.new_points;
  sum.pieces += more.pieces;
  sum.merged_points += more.merged_points;
  sum.largest_move_m = std::max(sum.largest_move_m, more.largest_move_m);
  sum.dropped_triangles += more.dropped_triangles;
  sum.rounds += more.rounds;
  sum.pairs_left = more.pairs_left;
}

}  // namespace

double sealing_distance_m(const TriangleSoup& soup, const SealSurfacesOptions& options) {
  return options.distance_m ? *options.distance_m : options.distance_ratio * box_of(soup).diagonal_m();
}

std::vector<NamedContact> contacts_with_distance(const std::vector<std::string>& contacts) {
  std::vector<NamedContact> named;
  for (const std::string& text : contacts) {
    const std::size_t arrow = text.find(" -> "), within = text.find(" within ");
    if (arrow == std::string::npos || within == std::string::npos || within < arrow) continue;
    named.push_back({text.substr(0, arrow), text.substr(arrow + 4, within - arrow - 4),
                     std::strtod(text.c_str() + within + 8, nullptr)});
  }
  return named;
}

namespace {

class Sealer {
 public:
  Sealer(const TriangleSoup& soup, const CutSurfacesOptions& cut, const SealSurfacesOptions& options)
      : input_(soup), options_(options), cutting_(cut) {
    extend_ = {sealing_distance_m(soup, options), contacts_with_distance(options.contacts)};
    constexpr double mitre = 1.5;  // a corner juts out further than its sides
    trim_distance_.assign(soup.entities.size(), mitre * extend_.distance_m);
    for (const NamedContact& contact : extend_.contacts)
      for (std::size_t e = 0; e < soup.entities.size(); ++e)
        if (soup.entities[e].name == contact.entity)
          trim_distance_[e] = std::max(trim_distance_[e], mitre * contact.distance_m);
    cutting_.intersection_tolerance_m =
        std::max(cutting_.intersection_tolerance_m, options.point_tolerance_ratio * box_of(soup).diagonal_m());
  }

  Result<CutResult> run() {
    result_.soup = input_;
    if (auto ok = make_contacts(); !ok) return ok.failure();
    if (auto ok = cut_again(); !ok) return ok.failure();
    return finish();
  }

  /// The rest, from surfaces whose contacts are made and that are cut.
  Result<CutResult> run_from(const CutResult& cut) {
    result_ = cut;
    return finish();
  }

 private:
  Result<CutResult> finish() {
    trim_juts();
    if (auto ok = lead_while_it_helps(); !ok) return ok.failure();
    if (auto ok = extend_while_it_helps(); !ok) return ok.failure();
    if (options_.trim_outside) {
      Result<TrimmedSurfaces> trimmed = trim_outside(result_.soup);
      if (!trimmed) return trimmed.failure();
      tell_trimmed(input_, trimmed->pieces, "trimmed_outside", "they lie outside the boundary surfaces",
                   result_.changes);
      result_.soup = std::move(trimmed->soup);
    }
    const double tenth = 0.1 * extend_.distance_m;
    MicroRegions micro;
    micro.volume_m3 = options_.micro_region_volume_m3.value_or(tenth * tenth * tenth);
    if (!options_.micro_region_volume_m3) {
      micro.sliver_volume_ratio = 1e-5;
      micro.sliver_thickness_m = 0.05 * extend_.distance_m;
    }
    Result<MergedRegions> merged = merge_micro_regions(result_.soup, micro);
    if (!merged) return merged.failure();
    result_.changes.insert(result_.changes.end(), merged->changes.begin(), merged->changes.end());
    result_.soup = std::move(merged->soup);
    return std::move(result_);
  }

  Result<void> make_contacts() {
    if (!(extend_.distance_m > 0) && options_.contacts.empty()) return {};
    const FindContactsOptions search{.distance_m = extend_.distance_m};
    const Result<FoundContacts> named = name_contacts(input_, options_.contacts, search);
    if (!named) return named.failure();
    const Result<bool> ok = lead(joined(*named, find_contacts(input_, search)));
    return ok ? Result<void>{} : ok.failure();
  }

  /// Whether there was any contact to make.
  Result<bool> lead(const FoundContacts& contacts) {
    if (contacts.constraints.borders.empty() && contacts.constraints.stones.empty()) return false;
    Result<ConstrainedCut> made = cut_constrained(result_.soup, contacts.constraints);
    if (!made) return made.failure();
    for (std::size_t i = 0; i < contacts.gaps.size(); ++i)
      if (made->borders[i].failures.empty())
        result_.changes.push_back(
            {"made_contact",
             describe(result_.soup, contacts.constraints.borders[i], contacts.gaps[i]) + "; led onto it",
             "named, or within the sealing distance of " + metres(extend_.distance_m)});
    result_.soup = std::move(made->soup);
    return true;
  }

  /// Border edges that stop short.
  Result<std::uint64_t> count_short_edges() const {
    const Result<std::vector<BorderGap>> gaps = find_gaps(result_.soup, extend_);
    if (!gaps) return gaps.failure();
    return edge_count(*gaps);
  }

  /// What the exact cut left open along borders that it made contacts of in part: led onto them like the rest.
  Result<void> lead_while_it_helps() {
    Result<std::uint64_t> count = count_short_edges();
    if (!count) return count.failure();
    for (int pass = 0; pass < options_.passes; ++pass) {
      if (*count == 0) return {};
      CutResult before = result_;
      const Result<bool> is_led = lead(find_contacts(result_.soup, {.distance_m = extend_.distance_m}));
      if (!is_led) return is_led.failure();
      if (!*is_led) return {};
      if (auto ok = cut_again(); !ok) return ok;
      trim_juts();
      const std::uint64_t last = *count;
      count = count_short_edges();
      if (!count) return count.failure();
      if (*count < last) continue;
      result_ = std::move(before);
      return {};
    }
    return {};
  }

  Result<void> cut_again() {
    Result<CutResult> cut = cut_surfaces(result_.soup, cutting_);
    if (!cut) return cut.failure();
    add(result_.report, cut->report);
    result_.changes.insert(result_.changes.end(), cut->changes.begin(), cut->changes.end());
    result_.soup = std::move(cut->soup);
    return {};
  }

  void trim_juts() {
    if (!options_.trim) return;
    TrimmedSurfaces trimmed = trim_overshoot(result_.soup, 0, trim_distance_);
    tell_trimmed(input_, trimmed.pieces, "trimmed", "they jut out past contacts by less than the sealing distance",
                 result_.changes);
    result_.soup = std::move(trimmed.soup);
  }

  /// Each pass goes further past what it should reach than the one before. A pass that closes nothing is undone.
  Result<void> extend_while_it_helps() {
    std::uint64_t short_edges = std::numeric_limits<std::uint64_t>::max();
    CutResult before;  // as it was before the last pass
    for (int pass = 0; pass <= options_.passes; ++pass) {
      Result<ExtendedBorders> extended = extend_borders(result_.soup, extend_);
      if (!extended) return extended.failure();
      const std::uint64_t count = edge_count(extended->gaps);
      if (count >= short_edges) {
        result_ = std::move(before);
        return {};
      }
      short_edges = count;
      if (extended->moved_points == 0 || pass == options_.passes) return {};
      before = result_;
      for (const BorderGap& gap : extended->gaps)
        result_.changes.push_back({"extended_border",
                                   "'" + input_.entities[gap.entity].name + "' stopped up to " + metres(gap.largest_m) +
                                       " short of '" + input_.entities[gap.onto].name + "' along " +
                                       std::to_string(gap.edge_count) + " border edges",
                                   "within the sealing distance of " + metres(extend_.distance_m)});
      result_.soup = std::move(extended->soup);
      if (auto ok = cut_again(); !ok) return ok;
      trim_juts();
      extend_.margin_ratio *= 2;
      extend_.edge_margin_ratio *= 2;
    }
    return {};
  }

  const TriangleSoup& input_;
  const SealSurfacesOptions& options_;
  CutSurfacesOptions cutting_;
  ExtendBordersOptions extend_;
  std::vector<double> trim_distance_;  ///< per entity
  CutResult result_;
};

}  // namespace

Result<CutResult> seal_surfaces(const TriangleSoup& soup, const CutSurfacesOptions& cut,
                                const SealSurfacesOptions& options) {
  return Sealer(soup, cut, options).run();
}

Result<CutResult> seal_cut_surfaces(const CutResult& cut, const CutSurfacesOptions& cutting,
                                    const SealSurfacesOptions& options) {
  return Sealer(cut.soup, cutting, options).run_from(cut);
}

}  // namespace strataflow
