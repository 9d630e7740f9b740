#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/id.h"
#include "model/structural_model.h"

namespace strataflow {

/// Square of the distance of p from the triangle abc, quicker than its nearest point.
double square_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// The surfaces and lines of a model as a place to come back to: points are led to them by walking from a place near
/// by, so that a fold of the same surface, or its other end, is never mistaken for it. Keeps a reference to the model.
class InputSurfaces {
 public:
  explicit InputSurfaces(const StructuralModel& model);
  const StructuralModel& model() const { return model_; }

  struct Place {
    std::uint32_t triangle = no_index;
    Vec3 point;
  };
  /// Walks on the surface of triangle `start` towards p while it gets nearer, and gives the place where that ends.
  Place nearest(const Vec3& p, std::uint32_t start) const;
  /// Triangles of the model around one of its points.
  std::span<const std::uint32_t> around(std::uint32_t point) const {
    return {around_.data() + first_around_[point], around_.data() + first_around_[point + 1]};
  }
  /// The axis along which all points of a surface have one and the same coordinate, or −1.
  int flat_axis(std::uint32_t surface) const { return flat_axis_[surface]; }
  /// Flat, and nothing of the model lies beyond it: a side of the box.
  bool is_outermost(std::uint32_t surface) const { return is_outermost_[surface] != 0; }
  double area_m2(std::uint32_t surface) const { return area_m2_[surface]; }

  /// Arc length of a line, metres; all arc positions run from 0 (its first vertex) to this.
  double length_m(std::uint32_t line) const { return arcs_[first_arc_[line + 1] - 1]; }
  /// Where a vertex of the line lies along it.
  double arc_of(std::uint32_t line, std::size_t index) const { return arcs_[first_arc_[line] + index]; }
  /// Exactly the vertex where `arc_m` is one's; coordinates the whole segment shares stay exactly theirs. Beyond the
  /// end of a closed line it goes on from its first vertex.
  Vec3 point_at(std::uint32_t line, double arc_m) const;
  /// The largest distance of the line's vertices between two arc positions (of a closed line, perhaps across its first
  /// vertex) from the segment ab.
  double deviation_m(std::uint32_t line, double from_m, double to_m, const Vec3& a, const Vec3& b) const;


 private:
  Vec3 line_vertex(std::uint32_t line, std::size_t index) const;

  const StructuralModel& model_;
  std::vector<std::uint32_t> first_around_, around_;
  std::vector<std::int8_t> flat_axis_;
  std::vector<char> is_outermost_;
  std::vector<double> area_m2_;
  std::vector<std::uint32_t> first_arc_;  ///< per line, plus one
  std::vector<double> arcs_;              ///< per vertex of each line; a closed one's first comes again at the end
};

}  // namespace strataflow
