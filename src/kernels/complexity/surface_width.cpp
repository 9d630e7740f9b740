#include "kernels/complexity/surface_width.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/complexity/contact_wedges.h"

namespace strataflow {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Walks over one model.
class Walker {
 public:
  Walker(const StructuralModel& model, const BoxElements& box, const EdgeTable& edges)
      : model_(model), box_(box), edges_(edges), line_of_(line_of_edges(model, edges)) {}

  /// From a point on a half-edge across its triangle and on.
  double width_from(std::uint32_t half_edge, const Vec3& start, double reach_m) const {
    Vec3 at = start;
    Vec3 along = direction_of(half_edge), heading = inward_of(half_edge, along);
    double walked = 0;
    for (int steps = 0; steps < 100'000; ++steps) {
      const std::uint32_t t = half_edge / 3;
      const Vec3 normal = cross(along, inward_of(half_edge, along));
      // Leaves through the edge that is ahead and nearest along the heading.
      double nearest = endless;
      std::uint32_t exit = no_index;
      for (std::uint32_t k = 1; k < 3; ++k) {
        const std::uint32_t h = 3 * t + (half_edge + k) % 3;
        const Vec3 out = cross(direction_of(h), normal);
        const double speed = dot(heading, out);
        if (!(speed > 0)) continue;
        const double distance = std::max(0.0, dot(model_.points[model_.triangles[t][h % 3]] - at, out) / speed);
        if (distance < nearest) {
          nearest = distance;
          exit = h;
        }
      }
      if (exit == no_index) return endless;
      walked += nearest;
      if (!(walked < reach_m)) return endless;
      const std::uint32_t e = edges_.edge_of[exit];
      if (line_of_[e] != no_index) return box_.lines[line_of_[e]] != 0 ? endless : walked;
      std::uint32_t beyond = no_index;
      for (const std::uint32_t h : edges_.around(e))
        if (h / 3 != t) beyond = h;
      if (beyond == no_index) return endless;
      at = at + nearest * heading;
      half_edge = beyond;
      along = direction_of(beyond);
      const double kept = dot(heading, along);
      heading = kept * along + std::sqrt(std::max(0.0, 1 - kept * kept)) * inward_of(beyond, along);
    }
    return endless;
  }

 private:
  Vec3 direction_of(std::uint32_t h) const {
    const Triangle& t = model_.triangles[h / 3];
    const Vec3 edge = model_.points[t[(h + 1) % 3]] - model_.points[t[h % 3]];
    const double size = length(edge);
    return size > 0 ? (1 / size) * edge : Vec3{};
  }
  /// In the triangle's plane, across the half-edge, length 1.
  Vec3 inward_of(std::uint32_t h, const Vec3& along) const {
    const Triangle& t = model_.triangles[h / 3];
    const Vec3 to = model_.points[t[(h + 2) % 3]] - model_.points[t[h % 3]], across = to - dot(to, along) * along;
    const double size = length(across);
    return size > 0 ? (1 / size) * across : Vec3{};
  }

  const StructuralModel& model_;
  const BoxElements& box_;
  const EdgeTable& edges_;
  std::vector<std::uint32_t> line_of_;
};

}  // namespace

std::vector<WidthSample> sample_surface_width(const StructuralModel& model, const BoxElements& box,
                                              const EdgeTable& edges, double spacing_m, double reach_m) {
  const Walker walker(model, box, edges);
  const auto per_line = parallel_map(model.lines.size(), [&](std::size_t l) {
    std::vector<WidthSample> samples;
    const Line& line = model.lines[l];
    const std::size_t count = line.vertices.size();
    for (std::size_t i = 0; box.lines[l] == 0 && i < (line.is_closed() ? count : count - 1); ++i) {
      const Vec3 &from = model.points[line.vertices[i]], &to = model.points[line.vertices[(i + 1) % count]];
      const std::uint32_t e = find_edge(edges, line.vertices[i], line.vertices[(i + 1) % count]);
      if (e == no_index) continue;
      const double edge_m = length(to - from);
      const auto parts = static_cast<std::uint32_t>(std::clamp(std::ceil(edge_m / spacing_m), 1.0, 1e5));
      for (const std::uint32_t h : edges.around(e))
        for (std::uint32_t part = 0; part < parts; ++part) {
          const Vec3 start = from + ((part + 0.5) / parts) * (to - from);
          samples.push_back({model.triangle_surface[h / 3], static_cast<std::uint32_t>(l), edge_m / parts,
                             walker.width_from(h, start, reach_m)});
        }
    }
    return samples;
  });
  std::vector<WidthSample> samples;
  for (const auto& some : per_line) samples.insert(samples.end(), some.begin(), some.end());
  return samples;
}

}  // namespace strataflow
