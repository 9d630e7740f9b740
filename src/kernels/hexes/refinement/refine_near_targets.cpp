#include "kernels/hexes/refinement/refine_near_targets.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "graph/parallel/parallel_map.h"
#include "kernels/hexes/cell_states.h"
#include "kernels/hexes/extrusion/plan_zones.h"
#include "kernels/hexes/plan_lines.h"
#include "kernels/hexes/refinement/refine_quads.h"
#include "kernels/intersection/bounding_volume_tree.h"

namespace strataflow {
namespace {

using Segment = std::array<Vec3, 2>;

double distance_m(const Vec3& p, const Segment& s) {
  const Vec3 along = s[1] - s[0];
  const double squared = dot(along, along);
  return length(p - s[0] - (squared > 0 ? std::clamp(dot(p - s[0], along) / squared, 0.0, 1.0) : 0.0) * along);
}

double turn(const Vec3& a, const Vec3& b, const Vec3& p) { return cross(b - a, p - a).z; }

bool cross_each_other(const Segment& s, const Segment& t) {
  return turn(s[0], s[1], t[0]) * turn(s[0], s[1], t[1]) < 0 && turn(t[0], t[1], s[0]) * turn(t[0], t[1], s[1]) < 0;
}

/// Distances between quads and one target.
class TargetDistance {
 public:
  explicit TargetDistance(const RefinementTarget& target) : target_(target), segments_(target.segments) {
    for (const auto& area : target.areas)
      for (std::size_t k = 0; k < 3; ++k) segments_.push_back({area[k], area[(k + 1) % 3]});
    segment_tree_ = tree_of(segments_);
    area_tree_ = tree_of(target.areas);
  }

  bool is_near(const std::array<Vec3, 4>& quad, double within_m) const {
    const Vec3 reach{within_m, within_m, 0};
    Box3 box;
    for (const Vec3& p : quad) box.take(p);
    const Vec3 middle = 0.25 * (quad[0] + quad[1] + quad[2] + quad[3]);
    bool found = false;
    area_tree_.visit_items(enclosing({middle, middle}), [&](std::uint32_t n) {
      const auto& [a, b, c] = target_.areas[n];
      const double u = turn(a, b, middle), v = turn(b, c, middle), w = turn(c, a, middle);
      found = found || (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
    });
    // The border of an area alone takes no quad in: most of it may lie outside.
    const bool is_area = !target_.areas.empty();
    if (is_area && !(within_m > 0)) return found;
    segment_tree_.visit_items(enclosing({box.low - reach, box.high + reach}),
                              [&](std::uint32_t n) { found = found || reaches(segments_[n], quad, within_m); });
    return found;
  }

 private:
  static bool reaches(const Segment& segment, const std::array<Vec3, 4>& quad, double within_m) {
    bool is_inside = true;
    for (std::size_t k = 0; k < 4; ++k) {
      const Segment side{quad[k], quad[(k + 1) % 4]};
      is_inside = is_inside && turn(side[0], side[1], segment[0]) >= 0;
      if (distance_m(segment[0], side) <= within_m || distance_m(segment[1], side) <= within_m ||
          distance_m(side[0], segment) <= within_m || cross_each_other(side, segment))
        return true;
    }
    return is_inside;
  }

  template <class Shapes>
  static BoundingVolumeTree tree_of(const Shapes& shapes) {
    std::vector<FloatBox> boxes;
    for (const auto& shape : shapes) {
      Box3 box;
      for (const Vec3& p : shape) box.take(p);
      boxes.push_back(enclosing(box));
    }
    return BoundingVolumeTree(boxes);
  }

  const RefinementTarget& target_;
  std::vector<Segment> segments_;
  BoundingVolumeTree segment_tree_, area_tree_;
};

/// Borders of a region, seen from above: all it lies under is covered by them.
void add_region(const UprightModel& upright, std::int32_t region, RefinementTarget& target) {
  const LabelledTets& model = upright.model;
  for (std::uint32_t t = 0; t < model.tets.size(); ++t)
    for (std::uint32_t k = 0; k < 4 && model.region[t] == region; ++k) {
      const std::uint32_t other = model.neighbour[4 * t + k];
      if (other != no_index && model.region[other / 4] == region) continue;
      std::array<Vec3, 3> face;
      for (std::uint32_t c = 0; c < 3; ++c) face[c] = upright.plan[model.tets[t][(k + 1 + c) % 4]];
      if (std::abs(turn(face[0], face[1], face[2])) > 0) target.areas.push_back(face);
    }
}

}  // namespace

Result<RefinementTarget> refinement_target(const UprightModel& upright, const InputData& input, std::string name,
                                           double edge_m, double within_m) {
  RefinementTarget target{std::move(name), edge_m, within_m, {}, {}};
  bool is_known = false;
  const auto add_points = [&](const std::vector<Vec3>& points, bool is_line) {
    is_known = true;
    std::optional<Vec3> before;
    for (const Vec3& p : points) {
      const std::optional<Vec3> place = plan_position(upright.model, upright.plan, p.x, p.y);
      if (place) target.segments.push_back({is_line && before ? *before : *place, *place});
      before = place;
    }
  };
  for (const Polyline& line : input.lines)
    if (line.name == target.name) {
      // Columns are upright: a well is where it meets the top.
      const bool is_well = line.role == Role::well;
      add_points(is_well && !line.points.empty() ? std::vector<Vec3>{line.points.front()} : line.points, !is_well);
    }
  for (const PointSet& set : input.point_sets)
    if (set.name == target.name) add_points(set.points, false);
  for (const Polyline& line : upright.lines)
    if (line.role == Role::fault && line.name == target.name) {
      is_known = true;
      for (std::size_t i = 0; i + 1 < line.points.size(); ++i) target.segments.push_back({line.points[i], line.points[i + 1]});
    }
  const std::vector<std::string>& regions = upright.model.region_names;
  for (std::size_t r = 0; r < regions.size(); ++r)
    if (regions[r] == target.name) {
      is_known = true;
      add_region(upright, static_cast<std::int32_t>(r), target);
    }
  if (!is_known)
    return Failure{FailureCode::invalid_options,
                   "hex.refine_edge_m names '" + target.name + "', which is no well, point set, line, fault or region",
                   "use the names that `strataflow check` prints; a fault in hex.drop_alignment has no trace"};
  if (target.segments.empty() && target.areas.empty())
    return Failure{FailureCode::invalid_options, "hex.refine_edge_m: " + target.name + " lies beside the model",
                   "remove it, or correct its coordinates"};
  return target;
}

Result<QuadMesh> refine_near_targets(const QuadMesh& plan, const std::vector<RefinementTarget>& targets) {
  constexpr std::size_t most_quads = std::size_t{1} << 22;
  std::vector<TargetDistance> distances;
  distances.reserve(targets.size());
  for (const RefinementTarget& target : targets) distances.emplace_back(target);
  const double edge_m = mean_plan_edge_m(plan);
  std::vector<double> rounds;  // per target
  for (const RefinementTarget& target : targets) rounds.push_back(std::round(std::log(edge_m / target.edge_m) / std::log(3.0)));
  QuadMesh refined = plan;
  double now_m = edge_m;
  for (double round = 0; std::any_of(rounds.begin(), rounds.end(), [&](double all) { return round < all; }); ++round) {
    const std::vector<char> is_fine = parallel_map(
        refined.quads.size(),
        [&](std::size_t q) {
          std::array<Vec3, 4> quad;
          double around = 0;
          for (std::size_t k = 0; k < 4; ++k) {
            quad[k] = refined.points[refined.quads[q][k]];
            around += length(refined.points[refined.quads[q][(k + 1) % 4]] - quad[k]);
          }
          char fine = 0;
          for (std::size_t n = 0; n < targets.size() && !fine; ++n) {
            if (round >= rounds[n]) continue;
            // Rounds to come stay inside what this one makes.
            const double within_m = targets[n].within_m + (rounds[n] - 1 - round > 0 ? now_m : 0);
            fine = 0.25 * around > std::sqrt(3.0) * targets[n].edge_m && distances[n].is_near(quad, within_m) ? 1 : 0;
          }
          return fine;
        },
        32);
    const auto fine = static_cast<std::size_t>(std::count(is_fine.begin(), is_fine.end(), 1));
    if (refined.quads.size() + 8 * fine > most_quads)
      return Failure{FailureCode::geometry_failed, "refining makes more than 2^22 quads",
                     "ask for longer hex.refine_edge_m, or a shorter hex.refine_within_m"};
    // The rows of a volumetric fault stay: their points, and so the ends of their sides.
    const PlanZones zones = find_plan_zones(refined);
    std::vector<char> keeps = zones.is_on_strip;
    for (std::size_t q = 0; q < refined.quads.size(); ++q) {
      const std::int32_t zone = zones.zone_of[q];
      if (zone < 0 || zones.zones[static_cast<std::size_t>(zone)].role != Role::fault) continue;
      for (const std::uint32_t p : refined.quads[q]) keeps[p] = 1;
    }
    refined = refine_quads(refined, is_fine, keeps);
    now_m /= 3;
  }
  if (refined.quads.size() > plan.quads.size())
    refined.changes.push_back({"refined_plan",
                               std::to_string(plan.quads.size()) + " quads became " + std::to_string(refined.quads.size()),
                               "hex.refine_edge_m"});
  return refined;
}

}  // namespace strataflow
