#include "kernels/complexity/fault_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "base/id.h"
#include "kernels/complexity/principal_axes.h"

namespace strataflow {

namespace {

constexpr double degrees = 180 / std::numbers::pi;
using Weighted = std::vector<std::pair<double, double>>;

bool is_horizon(const Entity& entity) { return entity.role == Role::horizon || entity.role == Role::unconformity; }

bool belongs_to(const Surface& surface, std::uint32_t entity) {
  return std::binary_search(surface.all_entities.begin(), surface.all_entities.end(), entity);
}

/// A stretch of a horizon's cut-off on one side of a fault: place along strike and height of its ends.
struct CutOff {
  std::uint32_t horizon = 0;
  double length_m = 0;
  std::array<double, 2> along, height;
};

/// What happens along the lines of one fault.
class FaultWalk {
 public:
  FaultWalk(const StructuralModel& model, const EdgeTable& edges, std::uint32_t fault)
      : model_(model), edges_(edges), fault_(fault) {}

  FaultMeasures measure(Symmetric3& normals, double& area_m2) {
    fit_plane(normals, area_m2);
    for (const Line& line : model_.lines) {
      const std::size_t count = line.vertices.size();
      for (std::size_t i = 0; i < (line.is_closed() ? count : count - 1); ++i)
        if (const std::uint32_t e = find_edge(edges_, line.vertices[i], line.vertices[(i + 1) % count]); e != no_index)
          take_edge(e);
    }
    for (const int side : {0, 1}) measure_throws(cut_offs_[side], cut_offs_[1 - side]);
    for (std::uint32_t e = 0; e < model_.entities.size(); ++e) {
      if (horizons_.count(e) != 0) result_.horizons.push_back(model_.entities[e].name);
      if (faults_.count(e) != 0) result_.faults.push_back(model_.entities[e].name);
    }
    result_.layers_affected = static_cast<std::uint32_t>(result_.horizons.size() + 1);
    result_.throw_m = distribution_of(std::move(throws_));
    result_.horizon_angle_deg = distribution_of(std::move(horizon_angles_));
    result_.fault_angle_deg = distribution_of(std::move(fault_angles_));
    return std::move(result_);
  }

 private:
  void fit_plane(Symmetric3& normals, double& area_m2) {
    MassMoments moments;
    for (const Surface& surface : model_.surfaces)
      for (std::uint32_t t = surface.first_triangle; belongs_to(surface, fault_) && t < surface.end_triangle; ++t) {
        const auto [i, j, k] = model_.triangles[t];
        const Vec3& origin = model_.box.low;
        moments.take_triangle(model_.points[i] - origin, model_.points[j] - origin, model_.points[k] - origin);
        const Vec3 n = cross(model_.points[j] - model_.points[i], model_.points[k] - model_.points[i]);
        if (const double size = length(n); size > 0) {
          const Symmetric3 more = outer_product(n, n, 0.5 / size);
          for (std::size_t m = 0; m < 6; ++m) normals[m] += more[m];
        }
      }
    result_.name = model_.entities[fault_].name;
    result_.area_m2 = moments.mass();
    area_m2 += moments.mass();
    normal_ = moments.axes().axes[2];
    if (normal_.z < 0) normal_ = -1.0 * normal_;
    const double flat = std::hypot(normal_.x, normal_.y);
    result_.dip_deg = std::atan2(flat, normal_.z) * degrees;
    // The plane dips where its upward normal leans; strike lies to the left of that.
    if (flat > 0) strike_ = {-normal_.y / flat, normal_.x / flat, 0};
    double azimuth = std::atan2(strike_.x, strike_.y) * degrees;
    if (azimuth < 0) azimuth += 360;
    result_.strike_deg = azimuth;
  }

  Vec3 normal_of(std::uint32_t t) const {
    const auto [i, j, k] = model_.triangles[t];
    const Vec3 n = cross(model_.points[j] - model_.points[i], model_.points[k] - model_.points[i]);
    const double size = length(n);
    return size > 0 ? (1 / size) * n : Vec3{};
  }

  void take_edge(std::uint32_t e) {
    const auto around = edges_.around(e);
    const auto on_fault = std::find_if(around.begin(), around.end(), [&](std::uint32_t h) {
      return belongs_to(model_.surfaces[model_.triangle_surface[h / 3]], fault_);
    });
    if (on_fault == around.end()) return;
    const Vec3 &a = model_.points[edges_.edges[e][0]], &b = model_.points[edges_.edges[e][1]];
    const double edge_m = length(b - a);
    if (around.size() == 1) result_.free_border_m += edge_m;
    Vec3 fault_normal = normal_of(*on_fault / 3);
    const double angle_cosine = dot(fault_normal, normal_);
    if (angle_cosine < 0) fault_normal = -1.0 * fault_normal;
    std::set<std::array<std::uint32_t, 2>> taken;  // entity, side
    for (const std::uint32_t h : around) {
      const Surface& surface = model_.surfaces[model_.triangle_surface[h / 3]];
      if (belongs_to(surface, fault_)) continue;
      const Entity& entity = model_.entities[surface.entity];
      const bool is_other_fault = entity.role == Role::fault;
      if (!is_other_fault && !is_horizon(entity)) continue;
      const Vec3& far = model_.points[model_.triangles[h / 3][(h + 2) % 3]];
      const std::uint32_t side = dot(far - a, fault_normal) > 0 ? 1 : 0;
      if (!taken.insert({surface.entity, side}).second) continue;
      const double cosine = std::min(1.0, std::abs(dot(fault_normal, normal_of(h / 3))));
      (is_other_fault ? fault_angles_ : horizon_angles_).emplace_back(std::acos(cosine) * degrees, edge_m);
      (is_other_fault ? faults_ : horizons_).insert(surface.entity);
      if (!is_other_fault)
        cut_offs_[side].push_back({surface.entity, edge_m, {dot(a, strike_), dot(b, strike_)}, {a.z, b.z}});
    }
  }

  void measure_throws(const std::vector<CutOff>& here, const std::vector<CutOff>& across) {
    for (const CutOff& one : here) {
      const double along = 0.5 * (one.along[0] + one.along[1]), height = 0.5 * (one.height[0] + one.height[1]);
      double least = std::numeric_limits<double>::infinity();
      for (const CutOff& other : across) {
        const double from = other.along[0], to = other.along[1];
        if (other.horizon != one.horizon || along < std::min(from, to) || along > std::max(from, to)) continue;
        const double share = from == to ? 0.5 : (along - from) / (to - from);
        least = std::min(least, std::abs(other.height[0] + share * (other.height[1] - other.height[0]) - height));
      }
      if (std::isfinite(least))
        throws_.emplace_back(least, one.length_m);
      else
        result_.unmatched_m += one.length_m;
    }
  }

  const StructuralModel& model_;
  const EdgeTable& edges_;
  std::uint32_t fault_;
  Vec3 normal_, strike_{0, 1, 0};
  std::array<std::vector<CutOff>, 2> cut_offs_;  ///< below and above the fault
  Weighted throws_, horizon_angles_, fault_angles_;
  std::set<std::uint32_t> horizons_, faults_;
  FaultMeasures result_;
};

}  // namespace

LengthDistribution distribution_of(Weighted values) {
  LengthDistribution result;
  if (values.empty()) return result;
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const auto& [value, length_m] : values) {
    result.length_m += length_m;
    sum += value * length_m;
  }
  const auto quantile = [&](double q) {
    double passed = 0;
    for (const auto& [value, length_m] : values)
      if ((passed += length_m) >= q * result.length_m) return value;
    return values.back().first;
  };
  result.minimum = values.front().first;
  result.maximum = values.back().first;
  result.q50 = quantile(0.5);
  result.q90 = quantile(0.9);
  result.mean = result.length_m > 0 ? sum / result.length_m : 0;
  return result;
}

FaultReport measure_faults(const StructuralModel& model, const EdgeTable& edges) {
  FaultReport report;
  FaultNetworkMeasures& network = report.network;
  Symmetric3 normals{};
  double area_m2 = 0;
  network.smallest_angle_deg = 90;
  for (std::uint32_t e = 0; e < model.entities.size(); ++e) {
    if (model.entities[e].role != Role::fault ||
        std::none_of(model.surfaces.begin(), model.surfaces.end(), [&](const Surface& s) { return belongs_to(s, e); }))
      continue;
    const FaultMeasures& fault = report.faults.emplace_back(FaultWalk(model, edges, e).measure(normals, area_m2));
    ++network.faults;
    network.dying += fault.free_border_m > 0;
    network.contacts += static_cast<std::uint32_t>(fault.faults.size());
    network.contact_length_m += fault.fault_angle_deg.length_m;
    if (!fault.faults.empty())
      network.smallest_angle_deg = std::min(network.smallest_angle_deg, fault.fault_angle_deg.minimum);
  }
  network.contacts /= 2;  // each was met from both sides
  network.contact_length_m /= 2;
  if (network.contacts == 0) network.smallest_angle_deg = 0;
  if (area_m2 > 0) network.orientation_variation = std::max(0.0, 1 - principal_axes(normals).values[0] / area_m2);
  return report;
}

}  // namespace strataflow
