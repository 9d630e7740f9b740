#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/id.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// A triangulation of the plane z = 0 that takes points, with edges that stay. Half-edge h = 3·t + k runs from corner k
/// of triangle t to the next. Every triangle is counter-clockwise, exactly; edges that may be flipped are Delaunay
/// as far as a certain sign of the in-circle test tells.
class PlaneTriangulation {
 public:
  /// Edges between the two points (ascending) of a fixed edge are labelled with its index; all others may be flipped.
  PlaneTriangulation(std::vector<Vec3> points, std::vector<Triangle> triangles,
                     std::span<const std::array<std::uint32_t, 2>> fixed_edges);

  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  std::uint32_t half_edge_count() const { return static_cast<std::uint32_t>(3 * triangles_.size()); }
  std::uint32_t origin(std::uint32_t h) const { return triangles_[h / 3][h % 3]; }
  std::uint32_t target(std::uint32_t h) const { return triangles_[h / 3][next(h) % 3]; }
  std::uint32_t apex(std::uint32_t h) const { return triangles_[h / 3][previous(h) % 3]; }
  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  std::uint32_t opposite(std::uint32_t h) const { return across_[h]; }  ///< no_index outside
  std::uint32_t label(std::uint32_t h) const { return label_[h]; }      ///< index into fixed_edges, or no_index
  bool is_fixed(std::uint32_t h) const { return label_[h] != no_index; }
  /// A triangle at each point; no_index when there is none.
  std::uint32_t triangle_at(std::uint32_t point) const { return triangle_at_[point]; }
  /// Half-edges out of a point, counter-clockwise, starting at the boundary if there is one.
  std::vector<std::uint32_t> half_edges_from(std::uint32_t point) const;

  /// Drops triangles; numbers change.
  void keep(const std::vector<char>& is_kept);

  /// Puts a point on an edge, whose halves keep its label, or inside a triangle, then flips edges around it. Returns
  /// false and changes nothing if a triangle would not turn counter-clockwise.
  bool split_edge(std::uint32_t h, const Vec3& p);
  bool split_triangle(std::uint32_t t, const Vec3& p);
  /// Flips the edge if it may be and both triangles stay counter-clockwise.
  bool flip(std::uint32_t h);
  /// Flips edges until they are Delaunay, starting from the edges of `suspects`.
  void make_delaunay(std::vector<std::uint32_t> suspects);
  /// Moves a point if every triangle around it stays counter-clockwise.
  bool move(std::uint32_t point, const Vec3& to);
  bool in_circle(const Triangle& t, const Vec3& p) const;  ///< certainly inside

  /// Triangles changed since the last call, ascending.
  std::vector<std::uint32_t> take_touched();

 private:
  void set(std::uint32_t t, const Triangle& corners, const std::array<std::uint32_t, 3>& across,
           const std::array<std::uint32_t, 3>& labels);
  std::uint32_t add_triangle();

  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> across_, label_;  ///< per half-edge
  std::vector<std::uint32_t> triangle_at_;
  std::vector<std::uint32_t> touched_;
};

}  // namespace strataflow
