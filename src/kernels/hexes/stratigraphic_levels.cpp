#include "kernels/hexes/stratigraphic_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/topology/union_find.h"

namespace strataflow {
namespace {

Failure cannot_extrude(const std::string& name, const std::string& why) {
  return {FailureCode::unsupported, name + " " + why, "leave it out with drop_alignment = [\"" + name + "\"]"};
}

/// A part of the model between horizons and faults.
struct Part {
  std::vector<std::uint32_t> floors, roofs;  ///< places; ascending once complete
  std::int32_t region = 0;
};

class LevelSearch {
 public:
  explicit LevelSearch(const LabelledTets& tets)
      : tets_(tets), bottom_(static_cast<std::uint32_t>(tets.entities.size())), top_(bottom_ + 1) {}

  Result<StratigraphicLevels> find() {
    if (const Result<void> found = find_parts(); !found) return found.failure();
    if (const Result<void> sorted = sort_horizons(); !sorted) return sorted.failure();
    find_onlapped();
    StratigraphicLevels levels;
    levels.level_of.assign(tets_.entities.size(), no_index);
    for (const std::uint32_t entity : order_) {
      if (entity < bottom_) levels.level_of[entity] = level_[entity];
      levels.names.push_back(name_of(entity));
    }
    for (std::uint32_t t = 0; t < tets_.tets.size(); ++t) levels.unit.push_back(unit_of(parts_[part_[t]]));
    levels.changes = std::move(changes_);
    return levels;
  }

 private:
  std::string name_of(std::uint32_t place) const {
    return place == bottom_ ? "Bottom" : place == top_ ? "Top" : tets_.entities[place].name;
  }
  std::string region_name(const Part& part) const {
    const auto r = static_cast<std::size_t>(part.region);
    return part.region >= 0 && r < tets_.region_names.size() ? tets_.region_names[r]
                                                             : "region " + std::to_string(part.region);
  }

  /// Of each part its floors and roofs. Where a horizon lies below and above a part, a few triangles are overturned
  /// (the lesser share does not count) or scraps of it end inside the part (neither share counts), or it cannot be.
  Result<void> find_parts() {
    constexpr double tolerated_ratio = 0.01;  // of the greater share; of the part
    UnionFind pieces(tets_.tets.size());
    for (std::uint32_t face = 0; face < tets_.neighbour.size(); ++face)
      if (tets_.facet_of[face] == no_index) pieces.unite(face / 4, tets_.neighbour[face] / 4);
    part_.assign(tets_.tets.size(), 0);
    for (std::uint32_t t = 0; t < tets_.tets.size(); ++t) {
      const std::uint32_t root = pieces.find(t);
      if (root == t) parts_.push_back({{}, {}, tets_.region[t]});
      part_[t] = root == t ? static_cast<std::uint32_t>(parts_.size()) - 1 : part_[root];
    }
    height_.assign(top_ + 1, {0, 0});
    std::map<std::array<std::uint32_t, 2>, std::array<double, 2>> areas;  // part, horizon: as floor, as roof
    std::vector<double> part_area(parts_.size(), 0);
    for (std::uint32_t face = 0; face < tets_.facet_of.size(); ++face) {
      if (tets_.facet_of[face] == no_index) continue;
      const SheetFacet& facet = tets_.facets[tets_.facet_of[face]];
      Part& part = parts_[part_[face / 4]];
      const auto [a, b, c] = face_vertices(tets_.tets[face / 4], face % 4);
      const Vec3 &p = tets_.points[a], &q = tets_.points[b], &r = tets_.points[c];
      const double area = 0.5 * std::abs(cross(q - p, r - p).z);  // seen from above
      if (facet.kind == SheetKind::top) part.roofs.push_back(top_);
      if (facet.kind == SheetKind::bottom) part.floors.push_back(bottom_);
      part_area[part_[face / 4]] += 0.5 * area;  // floors and roofs see the same ground
      if (facet.kind != SheetKind::horizon) continue;
      if (const int up = orientation_2d(p.x, p.y, q.x, q.y, r.x, r.y); up != 0)
        areas[{part_[face / 4], facet.entity}][up > 0 ? 1 : 0] += area;
      height_[facet.entity][0] += 1;
      height_[facet.entity][1] += p.z + q.z + r.z;
    }
    std::vector<double> passed_over(tets_.entities.size(), 0);
    for (const auto& [key, area] : areas) {
      Part& part = parts_[key[0]];
      const auto& [floor, roof] = area;
      const double less = std::min(floor, roof), more = std::max(floor, roof);
      const bool is_scrap = less > 0 && more <= tolerated_ratio * part_area[key[0]];
      if (less > tolerated_ratio * more && !is_scrap)
        return cannot_extrude(name_of(key[1]),
                              "lies below and above " + region_name(part) + ": it is overturned, or ends inside it");
      passed_over[key[1]] += is_scrap ? less + more : less;
      if (!is_scrap && more > 0) (floor > roof ? part.floors : part.roofs).push_back(key[1]);
    }
    for (std::uint32_t entity = 0; entity < passed_over.size(); ++entity)
      if (passed_over[entity] > 0)
        changes_.push_back(
            {"passed_over", std::to_string(std::llround(passed_over[entity])) + " m2 of " + name_of(entity),
             "they lie below and above the same region, or are overturned, and are too small to part anything"});
    for (Part& part : parts_) {
      part.floors = sorted_unique(std::move(part.floors));
      part.roofs = sorted_unique(std::move(part.roofs));
    }
    return {};
  }

  double mean_height(std::uint32_t entity) const { return height_[entity][1] / height_[entity][0]; }

  Result<void> sort_horizons() {
    std::vector<std::array<std::uint32_t, 2>> over;  // lower, upper
    for (const Part& part : parts_)
      for (const std::uint32_t floor : part.floors)
        for (const std::uint32_t roof : part.roofs)
          if (floor < bottom_ && roof < bottom_) over.push_back({floor, roof});
    std::sort(over.begin(), over.end());
    over.erase(std::unique(over.begin(), over.end()), over.end());
    std::vector<std::uint32_t> waiting, below(bottom_, 0);
    for (const auto& pair : over) ++below[pair[1]];
    for (std::uint32_t entity = 0; entity < bottom_; ++entity)
      if (height_[entity][0] > 0) waiting.push_back(entity);
    order_ = {bottom_};
    while (!waiting.empty()) {
      auto lowest = waiting.end();
      for (auto it = waiting.begin(); it != waiting.end(); ++it)
        if (below[*it] == 0 && (lowest == waiting.end() || mean_height(*it) < mean_height(*lowest))) lowest = it;
      if (lowest == waiting.end()) {
        std::string names;
        for (const std::uint32_t entity : waiting) names += (names.empty() ? "" : ", ") + name_of(entity);
        return Failure{FailureCode::unsupported,
                       "these horizons lie over each other in a circle, or above one that does: " + names,
                       "check their order, or leave one out with drop_alignment"};
      }
      for (const auto& pair : over)
        if (pair[0] == *lowest) --below[pair[1]];
      order_.push_back(*lowest);
      waiting.erase(lowest);
    }
    order_.push_back(top_);
    level_.assign(top_ + 1, 0);
    for (std::uint32_t level = 0; level < order_.size(); ++level) level_[order_[level]] = level;
    return {};
  }

  /// Horizons that others end on from above: floors of a part beside a higher floor.
  void find_onlapped() {
    is_onlapped_.assign(order_.size(), 0);
    for (const Part& part : parts_)
      for (const std::uint32_t floor : part.floors)
        if (level_[floor] < highest_floor(part)) is_onlapped_[level_[floor]] = 1;
  }

  std::uint32_t highest_floor(const Part& part) const {
    std::uint32_t level = 0;
    for (const std::uint32_t floor : part.floors) level = std::max(level, level_[floor]);
    return level;
  }

  std::uint32_t unit_of(const Part& part) const {
    const std::uint32_t floor = highest_floor(part);
    std::uint32_t roof = level_[top_];
    for (const std::uint32_t each : part.roofs) roof = std::min(roof, level_[each]);
    return is_onlapped_[floor] != 0 && roof > floor ? roof - 1 : floor;
  }

  const LabelledTets& tets_;
  std::uint32_t bottom_ = 0, top_ = 0;  // places after the entities
  std::vector<std::uint32_t> part_;     // per tet
  std::vector<Part> parts_;
  std::vector<std::array<double, 2>> height_;  // per entity: facets, sum of z
  std::vector<std::uint32_t> order_, level_;   // places bottom up; per place its level
  std::vector<char> is_onlapped_;              // per level
  std::vector<Change> changes_;
};

}  // namespace

Result<StratigraphicLevels> find_stratigraphic_levels(const LabelledTets& tets) { return LevelSearch(tets).find(); }

}  // namespace strataflow
