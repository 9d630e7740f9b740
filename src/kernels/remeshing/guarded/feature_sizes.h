#pragma once
#include <cstdint>
#include <vector>

#include "kernels/remeshing/guarded/guarded_mesh.h"
#include "kernels/remeshing/guarded/input_surfaces.h"
#include "kernels/remeshing/guarded/triangle_grid.h"

namespace strataflow {

/// How small the input is around places of its lines: the length of a short line, and the gap to a line of the same
/// surface that is near by but far along the border (thin strips, narrow corners, slits).
class FeatureSizes {
 public:
  /// Gaps wider than `reach_m` are not looked for. Keeps a reference to `inputs`.
  FeatureSizes(const InputSurfaces& inputs, double reach_m);

  /// The feature size at a vertex of a line or corner of the mesh, at most reach_m.
  double at(const GuardedMesh& mesh, std::uint32_t v) const { return at(mesh, v, narrow_share); }
  /// The same, but of gaps only those of strips: lines that meet in a corner count no sooner than where they open by
  /// less than about 6°, for a wider corner is no narrower for short edges.
  double strip_m(const GuardedMesh& mesh, std::uint32_t v) const { return at(mesh, v, strip_share); }

 private:
  struct Segment {
    std::uint32_t line = 0;
    Vec3 a, b;
    double from_m = 0, to_m = 0;
  };
  /// A gap is one between places at least so many times as far apart along the border: its share of that way.
  static constexpr double narrow_share = 0.5, strip_share = 0.05;
  double at(const GuardedMesh& mesh, std::uint32_t v, double most_share) const;
  /// Gap seen from p on `line` at `arc_m`.
  double gap_m(const Vec3& p, std::uint32_t line, double arc_m, double most_share) const;
  double along_border_m(std::uint32_t line, double arc_m, std::uint32_t other, double other_arc_m) const;
  bool share_a_surface(std::uint32_t line, std::uint32_t other) const;

  const InputSurfaces& inputs_;
  double reach_m_;
  std::vector<Segment> segments_;
  TriangleGrid grid_;
  std::vector<std::uint32_t> first_corner_line_, corner_lines_;
};

/// Sets the size of every vertex: that of its surface (the least of them on lines), on lines no more than twice the
/// width of a strip but at least `smallest_ratio` of it, growing from there by no more than `growth` per metre along
/// edges. Strips so narrow that edges of `smallest_ratio` would not make their triangles good either are left alone.
void set_graded_sizes(GuardedMesh& mesh, const FeatureSizes& features, const std::vector<double>& surface_size_m,
                      double smallest_ratio, double growth);

}  // namespace strataflow
