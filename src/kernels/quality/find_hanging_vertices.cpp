#include "kernels/quality/find_hanging_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "graph/parallel/parallel_map.h"
#include "model/box3.h"

namespace strataflow {

namespace {

/// The vertices of the boundary, filed in the boxes of a regular grid.
class VertexGrid {
 public:
  VertexGrid(std::span<const Vec3> points, std::span<const CellFace> faces) : points_(points) {
    for (const CellFace& face : faces)
      for (const std::uint32_t vertex : face.vertices)
        if (vertex != no_index) vertices_.push_back(vertex);
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (const std::uint32_t vertex : vertices_) box_.take(points[vertex]);
    // A boundary is about as dense as a plane: this puts a few vertices into each box that has any.
    boxes_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(vertices_.size()) / 4)), 1, 128);
    begin_.assign(static_cast<std::size_t>(boxes_) * boxes_ * boxes_ + 1, 0);
    const auto box_of = [&](std::uint32_t vertex) {
      return index(cell(points_[vertex].x, 0), cell(points_[vertex].y, 1), cell(points_[vertex].z, 2));
    };
    for (const std::uint32_t vertex : vertices_) ++begin_[box_of(vertex) + 1];
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1), filed(vertices_.size());
    for (const std::uint32_t vertex : vertices_) filed[next[box_of(vertex)]++] = vertex;
    vertices_ = std::move(filed);
  }

  std::span<const std::uint32_t> vertices() const { return vertices_; }

  /// True as soon as `test(vertex)` is, for the vertices in the grid boxes that `region` meets.
  template <class Test>
  bool any_near(const Box3& region, Test&& test) const {
    for (int z = cell(region.low.z, 2); z <= cell(region.high.z, 2); ++z)
      for (int y = cell(region.low.y, 1); y <= cell(region.high.y, 1); ++y) {
        const std::size_t row = index(0, y, z);
        const std::uint32_t end = begin_[row + static_cast<std::size_t>(cell(region.high.x, 0)) + 1];
        for (std::uint32_t i = begin_[row + static_cast<std::size_t>(cell(region.low.x, 0))]; i < end; ++i)
          if (test(vertices_[i])) return true;
      }
    return false;
  }

 private:
  int cell(double coordinate, int axis) const {
    const double extent = box_.high[axis] - box_.low[axis];
    if (!(extent > 0)) return 0;
    return static_cast<int>(std::clamp((coordinate - box_.low[axis]) / extent, 0.0, 1.0) * (boxes_ - 1));
  }
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * boxes_ + static_cast<std::size_t>(y)) * boxes_ + static_cast<std::size_t>(x);
  }

  std::span<const Vec3> points_;
  Box3 box_;
  int boxes_ = 1;
  std::vector<std::uint32_t> vertices_;  ///< grouped by grid box, ascending in each
  std::vector<std::uint32_t> begin_;
};

Box3 inflated(Box3 box, double by) {
  box.low = box.low - Vec3{by, by, by};
  box.high = box.high + Vec3{by, by, by};
  return box;
}

/// `p` is within `tolerance` of the plane of the triangle, and inside it or within `tolerance` of it in that plane.
bool is_on_triangle(const Vec3& p, const std::array<Vec3, 3>& corner, double tolerance) {
  const Vec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double size = length(normal);
  if (!(size > 0) || std::abs(dot(normal, p - corner[0])) > tolerance * size) return false;
  for (int i = 0; i < 3; ++i) {
    const Vec3 edge = corner[(i + 1) % 3] - corner[i];
    if (dot(cross(normal, edge), p - corner[i]) < -tolerance * size * length(edge)) return false;
  }
  return true;
}

bool has_hanging_vertex(std::span<const Vec3> points, const CellFace& face, const VertexGrid& grid, double tolerance) {
  const int corners = face.is_triangle() ? 3 : 4;
  std::array<Vec3, 4> corner;
  Box3 box;
  for (int i = 0; i < corners; ++i) box.take(corner[i] = points[face.vertices[i]]);
  return grid.any_near(inflated(box, tolerance), [&](std::uint32_t vertex) {
    const Vec3& p = points[vertex];
    for (int i = 0; i < corners; ++i)
      if (face.vertices[i] == vertex || length(p - corner[i]) <= tolerance) return false;
    return is_on_triangle(p, {corner[0], corner[1], corner[2]}, tolerance) ||
           (corners == 4 && is_on_triangle(p, {corner[0], corner[2], corner[3]}, tolerance));
  });
}

}  // namespace

BoundaryContacts find_hanging_vertices(std::span<const Vec3> points, std::span<const CellFace> boundary_faces,
                                       double tolerance_m) {
  const VertexGrid grid(points, boundary_faces);
  constexpr std::size_t grain = 512;
  const auto is_hit = parallel_map(
      boundary_faces.size(),
      [&](std::size_t i) {
        return static_cast<char>(has_hanging_vertex(points, boundary_faces[i], grid, tolerance_m));
      },
      grain);
  const auto is_repeat = parallel_map(
      grid.vertices().size(),
      [&](std::size_t i) {
        const std::uint32_t vertex = grid.vertices()[i];
        Box3 box;
        box.take(points[vertex]);
        return static_cast<char>(grid.any_near(inflated(box, tolerance_m), [&](std::uint32_t other) {
          return other < vertex && length(points[other] - points[vertex]) <= tolerance_m;
        }));
      },
      grain);
  BoundaryContacts contacts;
  for (std::uint32_t i = 0; i < is_hit.size(); ++i)
    if (is_hit[i]) contacts.faces_with_hanging_vertex.push_back(i);
  contacts.coincident_vertices = static_cast<std::uint64_t>(std::count(is_repeat.begin(), is_repeat.end(), 1));
  return contacts;
}

}  // namespace strataflow
