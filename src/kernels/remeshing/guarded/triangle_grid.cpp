#include "kernels/remeshing/guarded/triangle_grid.h"

#include <cmath>

namespace strataflow {

TriangleGrid::TriangleGrid(const Box3& box, double cell_m, std::size_t most_cells) {
  const Vec3 extent = box.high - box.low;
  const auto cells_along = [&](int axis, double width) { return std::floor(extent[axis] / width) + 1; };
  double width = std::max(cell_m, 1e-9 * box.diagonal_m());
  if (!(width > 0)) width = 1;
  while (cells_along(0, width) * cells_along(1, width) * cells_along(2, width) > static_cast<double>(most_cells))
    width *= 1.25;
  for (std::size_t count = 0; count != 1; width *= 4) {
    Level& level = levels_.emplace_back();
    level.low = box.low;
    level.per_m = 1 / width;
    count = 1;
    for (int axis = 0; axis < 3; ++axis) count *= level.cells[axis] = static_cast<int>(cells_along(axis, width));
    level.heads.assign(count, no_index);
  }
}

std::size_t TriangleGrid::level_of(const FloatBox& box) const {
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) extent = std::max<double>(extent, box.high[axis] - box.low[axis]);
  std::size_t level = 0;
  while (level + 1 < levels_.size() && extent * levels_[level].per_m > 3) ++level;
  return level;
}

void TriangleGrid::insert(std::uint32_t triangle, const FloatBox& box) {
  if (triangle >= boxes_.size()) boxes_.resize(triangle + 1);
  boxes_[triangle] = box;
  Level& level = levels_[level_of(box)];
  ++level.triangles;
  level.for_each_cell(level.cells_of(box), [&](std::size_t cell) {
    std::uint32_t node = free_node_;
    if (node == no_index) {
      node = static_cast<std::uint32_t>(nodes_.size());
      nodes_.emplace_back();
    } else {
      free_node_ = nodes_[node].next;
    }
    nodes_[node] = {triangle, level.heads[cell], box};
    level.heads[cell] = node;
  });
}

void TriangleGrid::erase(std::uint32_t triangle) {
  Level& level = levels_[level_of(boxes_[triangle])];
  --level.triangles;
  level.for_each_cell(level.cells_of(boxes_[triangle]), [&](std::size_t cell) {
    std::uint32_t* link = &level.heads[cell];
    while (nodes_[*link].triangle != triangle) link = &nodes_[*link].next;
    const std::uint32_t node = *link;
    *link = nodes_[node].next;
    nodes_[node].next = free_node_;
    free_node_ = node;
  });
}

void TriangleGrid::move(std::uint32_t triangle, const FloatBox& box) {
  const std::size_t from = level_of(boxes_[triangle]);
  if (from == level_of(box) && levels_[from].cells_of(box) == levels_[from].cells_of(boxes_[triangle])) {
    boxes_[triangle] = box;
    const Level& level = levels_[from];
    level.for_each_cell(level.cells_of(box), [&](std::size_t cell) {
      std::uint32_t node = level.heads[cell];
      while (nodes_[node].triangle != triangle) node = nodes_[node].next;
      nodes_[node].box = box;
    });
  } else {
    erase(triangle);
    insert(triangle, box);
  }
}

}  // namespace strataflow
