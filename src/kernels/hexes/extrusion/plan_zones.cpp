#include "kernels/hexes/extrusion/plan_zones.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace strataflow {
namespace {

using Ends = std::array<std::uint32_t, 2>;

Ends ends_of(const QuadMesh& plan, std::uint32_t side) {
  const auto& quad = plan.quads[side / 4];
  const std::uint32_t a = quad[side % 4], b = quad[(side + 1) % 4];
  return {std::min(a, b), std::max(a, b)};
}

/// Sides 4·quad + k by their ends.
std::vector<std::uint32_t> sides_by_ends(const QuadMesh& plan) {
  std::vector<std::uint32_t> sides(4 * plan.quads.size());
  std::iota(sides.begin(), sides.end(), 0u);
  std::sort(sides.begin(), sides.end(), [&](std::uint32_t x, std::uint32_t y) {
    const Ends a = ends_of(plan, x), b = ends_of(plan, y);
    return a != b ? a < b : x < y;
  });
  return sides;
}

class ZoneSearch {
 public:
  explicit ZoneSearch(const QuadMesh& plan) : plan_(plan), sides_(sides_by_ends(plan)) {
    found_.zone_of.assign(plan.quads.size(), -1);
    found_.is_strip_feature.assign(plan.features.size(), 0);
    found_.is_on_strip.assign(plan.points.size(), 0);
  }

  PlanZones find() {
    for (std::uint32_t f = 0; f < plan_.features.size(); ++f) {
      if (plan_.features[f].strip_quads > 0) find_strip(f);
      if (plan_.features[f].role == Role::well) find_footprint(f);
    }
    for (const FeatureEdge& edge : plan_.edges)
      if (found_.is_strip_feature[edge.feature]) found_.is_on_strip[edge.a] = found_.is_on_strip[edge.b] = 1;
    return std::move(found_);
  }

 private:
  /// The sides with these ends: one or two.
  std::vector<std::uint32_t> sides_with(const Ends& ends) const {
    std::vector<std::uint32_t> found;
    auto it = std::lower_bound(sides_.begin(), sides_.end(), ends,
                               [&](std::uint32_t s, const Ends& wanted) { return ends_of(plan_, s) < wanted; });
    for (; it != sides_.end() && ends_of(plan_, *it) == ends; ++it) found.push_back(*it);
    return found;
  }

  void find_strip(std::uint32_t left) {
    const Feature& feature = plan_.features[left];
    found_.is_strip_feature[left] = 1;
    if (feature.strip_of < 0 || static_cast<std::size_t>(feature.strip_of) >= plan_.features.size()) return;
    const auto right = static_cast<std::uint32_t>(feature.strip_of);
    const std::string suffix = " left";
    std::string name = feature.name;
    if (name.size() > suffix.size() && name.ends_with(suffix)) name.resize(name.size() - suffix.size());
    found_.is_strip_feature[right] = 1;
    for (std::uint32_t f = 0; f < plan_.features.size(); ++f)
      if (plan_.features[f].name == name + " end") found_.is_strip_feature[f] = 1;
    const auto zone = static_cast<std::int32_t>(found_.zones.size());
    found_.zones.push_back({name, Role::fault});
    std::vector<Ends> right_edges;
    for (const FeatureEdge& edge : plan_.edges)
      if (edge.feature == right) right_edges.push_back({edge.a, edge.b});
    std::sort(right_edges.begin(), right_edges.end());
    for (const FeatureEdge& edge : plan_.edges) {
      if (edge.feature != left) continue;
      for (std::uint32_t side : sides_with({edge.a, edge.b})) {
        std::vector<std::uint32_t> row;
        while (row.size() < feature.strip_quads) {
          row.push_back(side / 4);
          const std::uint32_t across = 4 * (side / 4) + (side + 2) % 4;
          const Ends far = ends_of(plan_, across);
          if (row.size() == feature.strip_quads) {
            if (std::binary_search(right_edges.begin(), right_edges.end(), far))
              for (const std::uint32_t quad : row) found_.zone_of[quad] = zone;
            break;
          }
          const std::vector<std::uint32_t> next = sides_with(far);
          const auto other = std::find_if(next.begin(), next.end(), [&](std::uint32_t s) { return s / 4 != side / 4; });
          if (other == next.end()) break;
          side = *other;
        }
      }
    }
  }

  /// Quads whose middle an odd number of the curve's edges lies to the east of.
  void find_footprint(std::uint32_t well) {
    std::vector<FeatureEdge> around;
    std::vector<std::uint32_t> uses;
    for (const FeatureEdge& edge : plan_.edges)
      if (edge.feature == well) {
        around.push_back(edge);
        uses.push_back(edge.a);
        uses.push_back(edge.b);
      }
    std::sort(uses.begin(), uses.end());
    for (std::size_t i = 0; i < uses.size(); i += 2)
      if (i + 1 == uses.size() || uses[i] != uses[i + 1]) return;  // no closed curve: the well leans
    const auto zone = static_cast<std::int32_t>(found_.zones.size());
    found_.zones.push_back({plan_.features[well].name, Role::well});
    for (std::uint32_t q = 0; q < plan_.quads.size(); ++q) {
      Vec3 middle;
      for (const std::uint32_t p : plan_.quads[q]) middle = middle + 0.25 * plan_.points[p];
      bool is_inside = false;
      for (const FeatureEdge& edge : around) {
        const Vec3 &a = plan_.points[edge.a], &b = plan_.points[edge.b];
        if ((a.y > middle.y) == (b.y > middle.y)) continue;
        if (a.x + (middle.y - a.y) / (b.y - a.y) * (b.x - a.x) > middle.x) is_inside = !is_inside;
      }
      if (is_inside) found_.zone_of[q] = zone;
    }
  }

  const QuadMesh& plan_;
  std::vector<std::uint32_t> sides_;
  PlanZones found_;
};

}  // namespace

PlanZones find_plan_zones(const QuadMesh& plan) { return ZoneSearch(plan).find(); }

}  // namespace strataflow
