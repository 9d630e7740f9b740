#include "kernels/volumes/region_attempt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "model/box3.h"

namespace strataflow {

namespace {

/// The middle of [low, high], or 0 if subtracting it would round any of the coordinates.
double exact_centre(const std::vector<Vec3>& points, int axis, double low, double high) {
  const double extent = high - low;
  if (!(extent > 0)) return 0;
  const double step = std::exp2(std::floor(std::log2(extent)) - 4);  // few bits, so that differences stay short
  const double centre = step * std::round(0.5 * (low + high) / step);
  for (const Vec3& p : points) {
    const double difference = p[axis] - centre;
    const double back = difference + centre, lost = difference - (back - centre);
    if (back != p[axis] || lost != 0) return 0;
  }
  return centre;
}

}  // namespace

double vertical_stretch(const RegionBoundary& boundary) {
  double best_stretch = 1, best_shape = -1;
  for (const double stretch : {1.0, 2.0, 4.0, 8.0, 16.0}) {
    double shape = 0;
    for (const Triangle& facet : boundary.facets) {
      std::array<Vec3, 3> edges;
      for (std::size_t k = 0; k < 3; ++k) {
        edges[k] = boundary.coordinates[facet[(k + 1) % 3]] - boundary.coordinates[facet[k]];
        edges[k].z *= stretch;
      }
      const double squares = dot(edges[0], edges[0]) + dot(edges[1], edges[1]) + dot(edges[2], edges[2]);
      if (squares > 0) shape += length(cross(edges[0], edges[1])) / squares;
    }
    if (shape > best_shape) {
      best_shape = shape;
      best_stretch = stretch;
    }
  }
  return best_stretch;
}

std::string describe(const RegionAttempt& attempt) {
  return "TetGen -" + attempt.switches + (attempt.is_stretched ? ", stretched vertically" : "") +
         (attempt.has_turned_axes ? ", axes turned" : "") + (attempt.has_reversed_points ? ", points reversed" : "") +
         (attempt.has_reversed_facets ? ", facets reversed" : "");
}

std::vector<RegionAttempt> attempts_keeping_surfaces() {
  //       switches     stretched turned points facets
  return {{"pYQ", true, false, false, false},       {"pYQ", true, false, false, true},
          {"pYQ", false, false, false, true},       {"pYQ", false, true, false, false},
          {"pYQ", false, false, true, true},        {"pYQ", true, true, false, true},
          {"pYQ", false, false, false, false},      {"pYQO0", true, false, true, true},
          {"pYQT1e-10", false, false, false, true}, {"pYQT1e-12", false, true, false, true},
          {"pYQT1e-12", true, false, true, false}};
}

std::vector<RegionAttempt> attempts_splitting_surfaces() {
  std::vector<RegionAttempt> attempts = attempts_keeping_surfaces();  // they leave a point or two on an edge
  attempts.push_back({"pMQ", false, false, false, false});
  attempts.push_back({"pMQT1e-10", false, false, false, false});
  attempts.push_back({"pMQT1e-12", true, false, false, true});
  attempts.push_back({"pMQO0", false, true, false, false});
  return attempts;
}

std::string interior_switches(const TetrahedralizeOptions& options) {
  if (!options.min_dihedral_deg) return "";
  std::array<char, 64> text;
  constexpr double default_ratio = 2;
  std::snprintf(text.data(), text.size(), "q%.6f/%.6f", options.radius_edge_ratio.value_or(default_ratio),
                *options.min_dihedral_deg);
  return text.data();
}

RegionFrame::RegionFrame(const RegionBoundary& boundary, const RegionAttempt& attempt)
    : stretch_(attempt.is_stretched ? vertical_stretch(boundary) : 1), has_turned_axes_(attempt.has_turned_axes) {
  Box3 box;
  for (const Vec3& p : boundary.coordinates) box.take(p);
  for (int axis = 0; axis < 3; ++axis)
    centre_[axis] = exact_centre(boundary.coordinates, axis, box.low[axis], box.high[axis]);
}

Vec3 RegionFrame::sent(const Vec3& p) const {
  const Vec3 local{p.x - centre_.x, p.y - centre_.y, stretch_ * (p.z - centre_.z)};
  return has_turned_axes_ ? Vec3{local.y, local.z, local.x} : local;
}

Vec3 RegionFrame::restored(const Vec3& p) const {
  const Vec3 local = has_turned_axes_ ? Vec3{p.z, p.x, p.y} : p;
  return {local.x + centre_.x, local.y + centre_.y, local.z / stretch_ + centre_.z};
}

TetgenRequest request_for(const RegionBoundary& boundary, const RegionAttempt& attempt, const RegionFrame& frame,
                          const std::string& interior, std::uint64_t memory_limit_mb) {
  TetgenRequest request{attempt.switches + interior, {}, boundary.facets, memory_limit_mb};
  for (const Vec3& p : boundary.coordinates) request.points.push_back(frame.sent(p));
  if (attempt.has_reversed_points) {
    std::reverse(request.points.begin(), request.points.end());
    const auto last = static_cast<std::uint32_t>(request.points.size() - 1);
    for (Triangle& facet : request.facets)
      for (std::uint32_t& vertex : facet) vertex = last - vertex;
  }
  if (attempt.has_reversed_facets) std::reverse(request.facets.begin(), request.facets.end());
  return request;
}

RegionAnswer answer_from(const RegionBoundary& boundary, const RegionAttempt& attempt, const RegionFrame& frame,
                         TetgenResponse response) {
  RegionAnswer answer{boundary.coordinates, std::move(response.tets), std::move(response.subfaces),
                      std::move(response.subface_facet)};
  for (std::size_t i = answer.points.size(); i < response.points.size(); ++i)
    answer.points.push_back(frame.restored(response.points[i]));
  if (attempt.has_reversed_points) {
    const auto count = static_cast<std::uint32_t>(boundary.points.size());
    const auto renumber = [count](auto& cells) {
      for (auto& cell : cells)
        for (std::uint32_t& vertex : cell)
          if (vertex < count) vertex = count - 1 - vertex;
    };
    renumber(answer.tets);
    renumber(answer.subfaces);
  }
  if (attempt.has_reversed_facets)
    for (std::uint32_t& facet : answer.subface_facet)
      facet = static_cast<std::uint32_t>(boundary.facets.size()) - 1 - facet;
  return answer;
}

}  // namespace strataflow
