// Puts the vertices and triangles of a GuardedMesh that lie near one another near one another in memory.
#include <algorithm>
#include <cmath>

#include "kernels/remeshing/guarded/guarded_mesh.h"

namespace strataflow {

namespace {

/// The low ten bits of x with two zeros before each.
std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

/// Place along a Z-order curve through 1024 cells an axis.
std::uint32_t curve_place(const Vec3& p, const Box3& box, double cells_per_m) {
  std::uint32_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::clamp((p[axis] - box.low[axis]) * cells_per_m, 0.0, 1023.0);
    place |= spread_bits(static_cast<std::uint32_t>(cell)) << axis;
  }
  return place;
}

struct Placed {
  std::uint32_t place = 0, index = 0;
  friend bool operator<(const Placed& a, const Placed& b) {
    return a.place != b.place ? a.place < b.place : a.index < b.index;
  }
};

/// values[k] becomes what values[order[k].index] was.
template <class T>
void rearrange(std::vector<T>& values, const std::vector<Placed>& order) {
  std::vector<T> sorted;
  sorted.reserve(order.size());
  for (const Placed& from : order) sorted.push_back(values[from.index]);
  values = std::move(sorted);
}

}  // namespace

void GuardedMesh::renumber() {
  if (origin_) return;
  Box3 box;
  for (std::uint32_t v = 0; v < vertex_count(); ++v)
    if (is_alive_vertex(v)) box.take(points_[v]);
  const Vec3 extent = box.high - box.low;
  const double widest = std::max({extent[0], extent[1], extent[2]}), cells_per_m = widest > 0 ? 1024 / widest : 0;
  std::vector<Placed> vertices, triangles;
  for (std::uint32_t v = 0; v < vertex_count(); ++v)
    if (is_alive_vertex(v)) vertices.push_back({curve_place(points_[v], box, cells_per_m), v});
  std::sort(vertices.begin(), vertices.end());
  std::vector<std::uint32_t> number(points_.size(), no_index);
  for (std::uint32_t k = 0; k < vertices.size(); ++k) number[vertices[k].index] = k;
  const auto renumbered = [&](std::uint32_t v) { return v == no_index ? no_index : number[v]; };
  for (std::uint32_t t = 0; t < triangle_count(); ++t) {
    if (!is_alive(t)) continue;
    for (std::uint32_t& v : triangles_[t]) v = number[v];
    triangles.push_back({*std::min_element(triangles_[t].begin(), triangles_[t].end()), t});
  }
  std::sort(triangles.begin(), triangles.end());

  rearrange(points_, vertices);
  rearrange(kind_, vertices);
  rearrange(is_fixed_, vertices);
  rearrange(owner_, vertices);
  rearrange(arc_m_, vertices);
  rearrange(size_m_, vertices);
  rearrange(before_, vertices);
  rearrange(after_, vertices);
  rearrange(place_, vertices);
  for (std::vector<std::uint32_t>* links : {&before_, &after_})
    for (std::uint32_t& v : *links) v = renumbered(v);
  rearrange(triangles_, triangles);
  rearrange(surface_of_, triangles);
  rearrange(source_, triangles);
  rearrange(first_sample_, triangles);
  rearrange(changed_at_, triangles);
  free_.clear();
  removed_mark_.assign(triangles_.size(), 0);
  seen_mark_.assign(triangles_.size(), 0);
  vertex_mark_.assign(points_.size(), 0);

  // Each triangle's samples one after the other, in the order they were in.
  std::vector<Vec3> samples;
  samples.reserve(samples_.size());
  for (std::uint32_t& first : first_sample_) {
    const std::uint32_t begin = static_cast<std::uint32_t>(samples.size());
    for (std::uint32_t s = first; s != no_index; s = next_sample_[s]) samples.push_back(samples_[s]);
    first = begin == samples.size() ? no_index : begin;
  }
  samples_ = std::move(samples);
  for (std::uint32_t s = 0; s < samples_.size(); ++s) next_sample_[s] = s + 1;
  next_sample_.resize(samples_.size());
  for (const std::uint32_t first : first_sample_)
    if (first != no_index && first > 0) next_sample_[first - 1] = no_index;
  if (!next_sample_.empty()) next_sample_.back() = no_index;

  is_grid_filled_ = false;
  link_all();
}

}  // namespace strataflow
