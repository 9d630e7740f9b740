#include "kernels/quads/plan/snap_tips.h"

#include <algorithm>
#include <limits>

#include "kernels/quads/plan/plane_geometry.h"

namespace strataflow {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A place on a curve: on the segment that starts at point `segment`, or at that point itself.
struct CurvePlace {
  std::size_t curve = 0, segment = 0;
  Vec3 position;
  double distance_m = infinity;
};

class TipSnapper {
 public:
  TipSnapper(PlanCurves& plan, double limit_m) : plan_(plan), limit_m_(limit_m) {}

  void run() {
    for (std::size_t c = 0; c < plan_.curves.size(); ++c)
      for (const bool at_front : {true, false})
        if (!plan_.curves[c].is_closed) snap_end(c, at_front);
    for (Vec3& point : plan_.points) snap_point(point);
  }

 private:
  const std::string& name(std::size_t curve) const { return plan_.features[plan_.curves[curve].feature].name; }
  static std::size_t segment_count(const PlanCurve& c) { return c.points.size() - (c.is_closed ? 0 : 1); }
  static const Vec3& point(const PlanCurve& c, std::size_t i) { return c.points[i % c.points.size()]; }

  /// Makes `place` a point of its curve.
  void hold(const CurvePlace& place) {
    PlanCurve& curve = plan_.curves[place.curve];
    if (place.position == point(curve, place.segment) || place.position == point(curve, place.segment + 1)) return;
    curve.points.insert(curve.points.begin() + static_cast<std::ptrdiff_t>(place.segment + 1), place.position);
  }

  void snap_end(std::size_t c, bool at_front) {
    PlanCurve& own = plan_.curves[c];
    if (!at_front) std::reverse(own.points.begin(), own.points.end());
    const bool is_trimmed = trim(c);
    if (!is_trimmed) attach(c);
    if (!at_front) std::reverse(own.points.begin(), own.points.end());
  }

  /// Cuts the front of a curve off where it crosses another within the limit.
  bool trim(std::size_t c) {
    PlanCurve& own = plan_.curves[c];
    for (std::size_t i = tail_length(own); i-- > 0;) {
      CurvePlace best;
      double furthest_in = -1;
      const Vec3 p = own.points[i], q = own.points[i + 1];
      for (std::size_t other = 0; other < plan_.curves.size(); ++other) {
        if (other == c) continue;
        const PlanCurve& curve = plan_.curves[other];
        for (std::size_t s = 0; s < segment_count(curve); ++s) {
          const Vec3 a = point(curve, s), b = point(curve, s + 1);
          if (!cross_properly(p, q, a, b)) continue;
          const double t = std::abs(cross(a - p, b - a).z / cross(q - p, b - a).z);
          const Vec3 crossing = between(p, q, t);
          const auto near = [&](const Vec3& x) { return length(x - crossing) <= limit_m_; };
          if (t <= furthest_in ||
              !std::all_of(own.points.begin(), own.points.begin() + static_cast<std::ptrdiff_t>(i + 1), near))
            continue;
          furthest_in = t;
          best = {other, s, crossing, 0};
        }
      }
      if (furthest_in < 0 || !is_finite(best.position) || best.position == q) continue;
      hold(best);
      tell("trimmed", c, own.points.front(), best);
      for (std::size_t k = 0; k <= i; ++k) plan_.moved.push_back({own.points[k], best.position});
      own.points.erase(own.points.begin(), own.points.begin() + static_cast<std::ptrdiff_t>(i));
      own.points.front() = best.position;
      return true;
    }
    return false;
  }

  /// How many segments may lie within the limit of a crossing near the front.
  std::size_t tail_length(const PlanCurve& own) const {
    std::size_t count = 0;
    while (count < segment_count(own) && length(own.points[count] - own.points[0]) <= 2 * limit_m_) ++count;
    return count;
  }

  /// Moves the front of a curve onto the nearest end, else the nearest curve, within the limit.
  void attach(std::size_t c) {
    PlanCurve& own = plan_.curves[c];
    const Vec3 tip = own.points.front();
    CurvePlace best;
    for (std::size_t other = 0; other < plan_.curves.size(); ++other) {
      const PlanCurve& curve = plan_.curves[other];
      if (curve.is_closed || other == c) continue;
      for (const std::size_t end : {std::size_t{0}, curve.points.size() - 1}) {
        const double away = length(curve.points[end] - tip);
        if (away < best.distance_m) best = {other, std::min(end, curve.points.size() - 2), curve.points[end], away};
      }
    }
    if (!(best.distance_m <= limit_m_)) best = nearest_place(tip, c);
    if (!(best.distance_m <= limit_m_) || own.points[1] == best.position) return;
    hold(best);
    if (best.distance_m == 0) return;
    tell("snapped", c, tip, best);
    plan_.moved.push_back({tip, best.position});
    own.points.front() = best.position;
  }

  CurvePlace nearest_place(const Vec3& p, std::size_t own) const {
    CurvePlace best;
    for (std::size_t other = 0; other < plan_.curves.size(); ++other) {
      const PlanCurve& curve = plan_.curves[other];
      double arc = 0;
      for (std::size_t s = 0; s < segment_count(curve); ++s) {
        const Vec3 a = point(curve, s), b = point(curve, s + 1);
        const bool is_beside_tip = other == own && arc <= 4 * limit_m_;
        arc += length(b - a);
        if (is_beside_tip) continue;
        const double t = nearest_parameter(p, a, b);
        const Vec3 place = t == 0 ? a : t == 1 ? b : between(a, b, t);
        const double away = length(place - p);
        if (away < best.distance_m) best = {other, s, place, away};
      }
    }
    return best;
  }

  void snap_point(Vec3& p) {
    const CurvePlace best = nearest_place(p, plan_.curves.size());
    if (!(best.distance_m <= limit_m_)) return;
    hold(best);
    if (best.distance_m > 0)
      plan_.changes.push_back({"snapped", "point " + place_text(p),
                               "it lies " + short_number(best.distance_m) + " m from " + name(best.curve)});
    plan_.moved.push_back({p, best.position});
    p = best.position;
  }

  void tell(const char* kind, std::size_t c, const Vec3& tip, const CurvePlace& place) {
    const std::string how = kind == std::string("trimmed") ? "it juts out past " : "it ends near ";
    plan_.changes.push_back({kind, "end of " + name(c) + " at " + place_text(tip),
                             how + name(place.curve) + ", by " + short_number(length(tip - place.position)) + " m"});
  }

  PlanCurves& plan_;
  double limit_m_;
};

}  // namespace

void snap_tips(PlanCurves& plan, double limit_m) { TipSnapper(plan, limit_m).run(); }

}  // namespace strataflow
