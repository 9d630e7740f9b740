#include "kernels/remeshing/guarded/feature_sizes.h"

#include <algorithm>
#include <cmath>

#include "kernels/contacts/surface_search.h"

namespace strataflow {

namespace {
/// A strip narrower than this share of its edges has triangles with angles far below 30° whatever is done.
constexpr double hopeless_share = 0.375;
}  // namespace

FeatureSizes::FeatureSizes(const InputSurfaces& inputs, double reach_m) : inputs_(inputs), reach_m_(reach_m) {
  const StructuralModel& model = inputs.model();
  Box3 box;
  for (const Vec3& p : model.points) box.take(p);
  grid_ = TriangleGrid(box, reach_m, 1u << 20);
  std::vector<std::uint32_t> count(model.corners.size() + 1, 0);
  for (std::uint32_t i = 0; i < model.lines.size(); ++i) {
    const Line& line = model.lines[i];
    const std::size_t n = line.vertices.size();
    for (std::size_t k = 0; k + !line.is_closed() < n; ++k) {
      const Vec3 &a = model.points[line.vertices[k]], &b = model.points[line.vertices[(k + 1) % n]];
      Box3 own;
      own.take(a);
      own.take(b);
      grid_.insert(static_cast<std::uint32_t>(segments_.size()), enclosing(own));
      segments_.push_back({i, a, b, inputs.arc_of(i, k), inputs.arc_of(i, k + 1)});
    }
    if (!line.is_closed())
      for (const std::uint32_t c : line.corners) ++count[c + 1];
  }
  for (std::size_t c = 0; c < model.corners.size(); ++c) count[c + 1] += count[c];
  first_corner_line_ = count;
  corner_lines_.resize(count.back());
  for (std::uint32_t i = 0; i < model.lines.size(); ++i)
    if (!model.lines[i].is_closed())
      for (const std::uint32_t c : model.lines[i].corners) corner_lines_[count[c]++] = i;
}

bool FeatureSizes::share_a_surface(std::uint32_t line, std::uint32_t other) const {
  const auto &a = inputs_.model().lines[line].surfaces, &b = inputs_.model().lines[other].surfaces;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j]) return true;
    a[i] < b[j] ? ++i : ++j;
  }
  return false;
}

double FeatureSizes::along_border_m(std::uint32_t line, double arc_m, std::uint32_t other, double other_arc_m) const {
  const Line &a = inputs_.model().lines[line], &b = inputs_.model().lines[other];
  double least = std::numeric_limits<double>::infinity();
  if (line == other) {
    least = std::abs(arc_m - other_arc_m);
    if (a.is_closed() || a.corners[0] == a.corners[1]) least = std::min(least, inputs_.length_m(line) - least);
  }
  if (a.is_closed() || b.is_closed()) return least;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (line != other && a.corners[i] == b.corners[j])
        least = std::min(least, (i == 0 ? arc_m : inputs_.length_m(line) - arc_m) +
                                    (j == 0 ? other_arc_m : inputs_.length_m(other) - other_arc_m));
  return least;
}

double FeatureSizes::gap_m(const Vec3& p, std::uint32_t line, double arc_m, double most_share) const {
  double gap = reach_m_;
  Box3 box;
  box.take(p - Vec3{reach_m_, reach_m_, reach_m_});
  box.take(p + Vec3{reach_m_, reach_m_, reach_m_});
  grid_.visit(enclosing(box), [&](std::uint32_t k) {
    const Segment& s = segments_[k];
    const Vec3 q = nearest_on_segment(p, s.a, s.b);
    const double d = length(q - p);
    if (!(d < gap) || !share_a_surface(line, s.line)) return;
    const double whole = length(s.b - s.a);
    const double arc = s.from_m + (whole > 0 ? length(q - s.a) / whole : 0) * (s.to_m - s.from_m);
    if (d < most_share * along_border_m(line, arc_m, s.line, arc)) gap = d;
  });
  return gap;
}

double FeatureSizes::at(const GuardedMesh& mesh, std::uint32_t v, double most_share) const {
  double size = reach_m_;
  const auto look = [&](std::uint32_t line, double arc_m) {
    size = std::min({size, inputs_.length_m(line), gap_m(mesh.point(v), line, arc_m, most_share)});
  };
  if (mesh.kind(v) == VertexKind::line) {
    look(mesh.owner(v), mesh.arcs_around(v)[1]);
  } else if (mesh.kind(v) == VertexKind::corner) {
    const std::uint32_t c = mesh.owner(v);
    for (std::uint32_t k = first_corner_line_[c]; k < first_corner_line_[c + 1]; ++k) {
      const std::uint32_t line = corner_lines_[k];
      look(line, inputs_.model().lines[line].corners[0] == c ? 0 : inputs_.length_m(line));
    }
  }
  return size;
}

void set_graded_sizes(GuardedMesh& mesh, const FeatureSizes& features, const std::vector<double>& surface_size_m,
                      double smallest_ratio, double growth) {
  std::vector<std::uint32_t> front;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive_vertex(v)) continue;
    double size = std::numeric_limits<double>::infinity();
    mesh.visit_star(v, [&](std::uint32_t t) { size = std::min(size, surface_size_m[mesh.surface_of(t)]); });
    if (mesh.kind(v) != VertexKind::surface)
      if (const double strip = features.strip_m(mesh, v); strip > hopeless_share * smallest_ratio * size)
        size = std::clamp(2 * strip, smallest_ratio * size, size);
    mesh.set_size_m(v, size);
    front.push_back(v);
  }
  std::vector<char> is_in_front(mesh.vertex_count(), 0);
  while (!front.empty()) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t v : front) is_in_front[v] = 0;
    for (const std::uint32_t v : front)
      mesh.visit_star(v, [&](std::uint32_t t) {
        for (const std::uint32_t w : mesh.triangle(t)) {
          const double size = mesh.size_m(v) + growth * length(mesh.point(w) - mesh.point(v));
          if (!(size < mesh.size_m(w) * (1 - 1e-3))) continue;
          mesh.set_size_m(w, size);
          if (is_in_front[w] == 0) {
            is_in_front[w] = 1;
            next.push_back(w);
          }
        }
      });
    front = std::move(next);
  }
}

}  // namespace strataflow
