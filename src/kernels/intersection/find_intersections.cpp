#include "kernels/intersection/find_intersections.h"

#include <bit>
#include <optional>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "kernels/intersection/unfolded_vertices.h"

namespace strataflow {

namespace {

constexpr std::size_t triangle_grain = 16384;
/// Leaves whose pairs one task looks for. They are neighbours along the curve, so one descent serves them all.
constexpr std::uint32_t leaves_per_block = 8;
constexpr std::size_t blocks_per_task = 32;

FloatBox box_of_leaves(const BoundingVolumeTree& tree, std::uint32_t begin, std::uint32_t end) {
  FloatBox box = tree.leaf_box(begin);
  for (std::uint32_t leaf = begin + 1; leaf < end; ++leaf) box = joined(box, tree.leaf_box(leaf));
  return box;
}

FloatBox box_of(const std::vector<Vec3>& points, const Triangle& triangle) {
  Box3 box;
  for (const std::uint32_t v : triangle) box.take(points[v]);
  return enclosing(box);
}

/// The vertices of a leaf's triangles side by side.
struct FourTriangles {
  std::array<std::array<std::uint32_t, 4>, 3> vertices;

  Triangle triangle(std::uint32_t k) const { return {vertices[0][k], vertices[1][k], vertices[2][k]}; }

  /// Of the triangles marked by bit k in `hits`: those with none of the vertices of `t`.
  std::uint32_t without(const Triangle& t, std::uint32_t hits) const {
    using Four = std::uint32_t __attribute__((vector_size(16)));
    const Four a = std::bit_cast<Four>(vertices[0]), b = std::bit_cast<Four>(vertices[1]),
               c = std::bit_cast<Four>(vertices[2]);
    auto shared = (a == t[0]) | (a == t[1]) | (a == t[2]);
    shared |= (b == t[0]) | (b == t[1]) | (b == t[2]);
    shared |= (c == t[0]) | (c == t[1]) | (c == t[2]);
    shared &= decltype(shared){1, 2, 4, 8};
    return hits & ~static_cast<std::uint32_t>(shared[0] | shared[1] | shared[2] | shared[3]);
  }
};

/// One triangle, asked whether many others surely keep clear of it: orientation_3d and orientation_2d under the same
/// error bounds, with what depends on this triangle worked out once.
class ClearanceOfTriangle {
 public:
  ClearanceOfTriangle(const Vec3& a, const Vec3& b, const Vec3& c) : a_(a) {
    const Vec3 u = b - a, v = c - a;
    const auto minor = [](double ub, double vc, double uc, double vb, double& value, double& size) {
      const double left = ub * vc, right = uc * vb;
      value = left - right;
      size = std::abs(left) + std::abs(right);
    };
    minor(u.y, v.z, u.z, v.y, normal_.x, size_.x);
    minor(u.z, v.x, u.x, v.z, normal_.y, size_.y);
    minor(u.x, v.y, u.y, v.x, normal_.z, size_.z);
    corner_ = {&a, &b, &c};
    const double x = std::abs(normal_.x), y = std::abs(normal_.y), z = std::abs(normal_.z);
    axis_ = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
    constexpr double unit = 0x1.0p-53, bound = (3.0 + 16.0 * unit) * unit;
    const double noise = std::max(bound * size_[axis_], 1e-270);
    outside_ = normal_[axis_] > noise ? -1 : normal_[axis_] < -noise ? 1 : 0;  // 0: it may be seen edge on
    if (axis_ == 1) outside_ = -outside_;                                      // seen along y, x and z are left-handed
  }

  /// The triangle of these points surely shares nothing with this one.
  bool is_kept_by(const Vec3& p, const Vec3& q, const Vec3& r) const {
    return has_on_one_side(p, q, r) || has_beyond_an_edge(p, q, r);
  }

 private:
  /// The three points lie strictly on one side of the plane; false when rounding could decide.
  bool has_on_one_side(const Vec3& p, const Vec3& q, const Vec3& r) const {
    const int side = surely(p);
    return side != 0 && surely(q) == side && surely(r) == side;
  }

  /// Seen along the triangle's main axis, the three points lie strictly beyond one of its edges.
  bool has_beyond_an_edge(const Vec3& p, const Vec3& q, const Vec3& r) const {
    const int s = axis_ == 0 ? 1 : 0, t = axis_ == 2 ? 1 : 2;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &from = *corner_[k], &to = *corner_[k == 2 ? 0 : k + 1];
      const double along_s = to[s] - from[s], along_t = to[t] - from[t];
      const auto is_beyond = [&](const Vec3& point) {
        const double left = along_s * (point[t] - from[t]), right = along_t * (point[s] - from[s]);
        constexpr double unit = 0x1.0p-53, bound = (3.0 + 16.0 * unit) * unit;
        const double sum = std::abs(left) + std::abs(right);
        return sum > 1e-270 && outside_ * (left - right) > bound * sum;
      };
      if (is_beyond(p) && is_beyond(q) && is_beyond(r)) return true;
    }
    return false;
  }

  int surely(const Vec3& p) const {
    const Vec3 w = p - a_;
    const double determinant = w.x * normal_.x + w.y * normal_.y + w.z * normal_.z;
    const double permanent = std::abs(w.x) * size_.x + std::abs(w.y) * size_.y + std::abs(w.z) * size_.z;
    constexpr double unit = 0x1.0p-53, bound = (7.0 + 56.0 * unit) * unit;
    if (!(permanent > 1e-270)) return 0;  // underflow could have eaten something
    return determinant > bound * permanent ? 1 : determinant < -bound * permanent ? -1 : 0;
  }

  Vec3 a_, normal_, size_;
  std::array<const Vec3*, 3> corner_{};
  int axis_ = 2, outside_ = 1;
};

void sort_pairs(std::vector<IntersectingPair>& pairs) {
  sort_total_order(pairs, [](const IntersectingPair& a, const IntersectingPair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
}

}  // namespace

bool is_degenerate(const std::vector<Vec3>& points, const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || projection_axis(points[t[0]], points[t[1]], points[t[2]]) < 0;
}

std::vector<IntersectingPair> find_intersections(const std::vector<Vec3>& points,
                                                 const std::vector<Triangle>& triangles) {
  // A triangle of zero area has a box that overlaps nothing.
  UnsetVector<FloatBox> boxes(triangles.size());
  parallel_ranges(triangles.size(), triangle_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      boxes[t] = is_degenerate(points, triangles[t]) ? FloatBox::nothing() : box_of(points, triangles[t]);
  });
  const BoundingVolumeTree tree(boxes);
  boxes = {};

  // Triangles in the order of the curve: what one task reads lies together.
  const std::uint32_t count = tree.item_count();
  const std::uint32_t leaf_count = tree.leaf_count();
  UnsetVector<FourTriangles> leaves(leaf_count);
  parallel_ranges(leaf_count, triangle_grain / BoundingVolumeTree::leaf_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf)
      for (std::uint32_t k = 0; k < BoundingVolumeTree::leaf_size; ++k) {
        const auto place = static_cast<std::uint32_t>(leaf * BoundingVolumeTree::leaf_size + k);
        const Triangle t = place < count ? triangles[tree.item_at(place)] : Triangle{no_index, no_index, no_index};
        for (int i = 0; i < 3; ++i) leaves[leaf].vertices[i][k] = t[i];
      }
  });
  // Vertices at which no two triangles meet improperly.
  const std::vector<char> is_unfolded = find_unfolded_vertices(points, triangles);

  const std::size_t block_count = (leaf_count + leaves_per_block - 1) / leaves_per_block;
  const std::size_t task_count = (block_count + blocks_per_task - 1) / blocks_per_task;
  const auto found = parallel_map(task_count, [&](std::size_t task) {
    std::vector<IntersectingPair> pairs;
    std::vector<std::uint32_t> near, nearer;
    std::vector<FourBoxes> near_boxes;
    for (std::size_t block = task * blocks_per_task; block < std::min(block_count, (task + 1) * blocks_per_task);
         ++block) {
      const auto first_leaf = static_cast<std::uint32_t>(block * leaves_per_block);
      const std::uint32_t end_leaf = std::min(leaf_count, first_leaf + leaves_per_block);
      // Each pair is looked for once, from the block that holds its earlier place.
      near.clear();
      near_boxes.clear();
      tree.visit_leaves(box_of_leaves(tree, first_leaf, end_leaf), first_leaf, [&](std::uint32_t leaf) {
        if (near.size() % 4 == 0) near_boxes.emplace_back();
        near_boxes.back().set(near.size() % 4, tree.leaf_box(leaf));
        near.push_back(leaf);
      });
      for (std::uint32_t leaf = first_leaf; leaf < end_leaf; ++leaf) {
        const FloatBox leaf_box = tree.leaf_box(leaf);
        nearer.clear();
        for (std::uint32_t four = 0; four < near_boxes.size(); ++four)
          for (std::uint32_t hits = near_boxes[four].overlaps(leaf_box); hits != 0; hits &= hits - 1) {
            const std::uint32_t i = 4 * four + static_cast<std::uint32_t>(std::countr_zero(hits));
            if (i < near.size() && near[i] >= leaf) nearer.push_back(near[i]);
          }
        const std::uint32_t begin = leaf * BoundingVolumeTree::leaf_size;
        const std::uint32_t end = std::min(count, begin + BoundingVolumeTree::leaf_size);
        for (std::uint32_t place = begin; place < end; ++place) {
          const FloatBox box = tree.box_at(place);
          const Triangle v = leaves[leaf].triangle(place - begin);
          Triangle unfolded = v;
          for (std::uint32_t& vertex : unfolded) vertex = is_unfolded[vertex] ? vertex : no_index;
          std::optional<ClearanceOfTriangle> clearance;
          for (const std::uint32_t other_leaf : nearer) {
            std::uint32_t hits = tree.item_boxes(other_leaf).overlaps(box);
            if (other_leaf == leaf) hits &= ~1u << (place - begin);  // later places only
            // Two that stand around an unfolded vertex meet properly: almost all neighbours.
            hits = leaves[other_leaf].without(unfolded, hits);
            for (; hits != 0; hits &= hits - 1) {
              const auto k = static_cast<std::uint32_t>(std::countr_zero(hits));
              const Triangle w = leaves[other_leaf].triangle(k);
              if (!clearance) clearance.emplace(points[v[0]], points[v[1]], points[v[2]]);
              if (clearance->is_kept_by(points[w[0]], points[w[1]], points[w[2]])) continue;
              const PairMeeting meeting = meeting_of(points, v, w);
              if (meeting == PairMeeting::proper) continue;
              const std::uint32_t t = tree.item_at(place);
              const std::uint32_t u = tree.item_at(other_leaf * BoundingVolumeTree::leaf_size + k);
              pairs.push_back({std::min(t, u), std::max(t, u), meeting});
            }
          }
        }
      }
    }
    return pairs;
  });
  std::vector<IntersectingPair> all;
  for (const auto& pairs : found) all.insert(all.end(), pairs.begin(), pairs.end());
  sort_pairs(all);
  return all;
}

std::vector<IntersectingPair> find_intersections_of(const std::vector<Vec3>& points,
                                                    const std::vector<Triangle>& triangles,
                                                    const std::vector<char>& is_changed) {
  std::vector<std::uint32_t> changed;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (is_changed[t] && !is_degenerate(points, triangles[t])) changed.push_back(t);
  const std::vector<FloatBox> boxes = parallel_map(
      changed.size(), [&](std::size_t i) { return box_of(points, triangles[changed[i]]); }, triangle_grain);
  const BoundingVolumeTree tree(boxes);
  Box3 reach;
  for (const std::uint32_t t : changed)
    for (const std::uint32_t v : triangles[t]) reach.take(points[v]);
  constexpr std::size_t grain = 2048;
  const auto found = parallel_map((triangles.size() + grain - 1) / grain, [&](std::size_t chunk) {
    std::vector<IntersectingPair> pairs;
    for (std::size_t i = chunk * grain; i < std::min(triangles.size(), (chunk + 1) * grain); ++i) {
      const auto t = static_cast<std::uint32_t>(i);
      if (changed.empty()) break;
      Box3 box;
      for (const std::uint32_t v : triangles[t]) box.take(points[v]);
      if (!overlap(box, reach)) continue;
      int degenerate = -1;  // asked only where something is near
      tree.visit_items(enclosing(box), [&](std::uint32_t item) {
        const std::uint32_t u = changed[item];
        if (u == t || (is_changed[t] && u < t)) return;
        if (degenerate < 0) degenerate = is_degenerate(points, triangles[t]) ? 1 : 0;
        if (degenerate == 1) return;
        const PairMeeting meeting = meeting_of(points, triangles[t], triangles[u]);
        if (meeting != PairMeeting::proper) pairs.push_back({std::min(t, u), std::max(t, u), meeting});
      });
    }
    return pairs;
  });
  std::vector<IntersectingPair> all;
  for (const auto& pairs : found) all.insert(all.end(), pairs.begin(), pairs.end());
  sort_pairs(all);
  return all;
}

}  // namespace strataflow
