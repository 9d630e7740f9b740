#include "kernels/hexes/smooth_hexes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "graph/parallel/parallel_map.h"
#include "kernels/hexes/cell_states.h"
#include "kernels/hexes/nearest_point.h"
#include "kernels/quality/cell_shape.h"
#include "kernels/quality/nearest_triangle.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {
namespace {

constexpr double warped_ratio = 0.05;  // of the mean edge: as bad as below_quality

/// Of a cell, or the worst of several.
struct CellQuality {
  double jacobian = 1;  ///< scaled
  double shape = 1;     ///< the same, less where a face is warped
  void take(const CellQuality& other) {
    jacobian = std::min(jacobian, other.jacobian);
    shape = std::min(shape, other.shape);
  }
};

class HexSmoother {
 public:
  HexSmoother(ExtrudedHexes& hexes, const LayeredSpace& space, const SmoothHexesOptions& options)
      : mesh_(hexes.grid.mesh),
        hexes_(hexes),
        space_(space),
        options_(options),
        edge_m_(mean_plan_edge_m(hexes.grid.plan)) {}

  HexSmoothing smooth() {
    find_cells_around();
    find_freedom();
    find_colours();
    quality_ = parallel_map(
        mesh_.cell_count(), [&](std::size_t c) { return quality_of(hex_corners(mesh_, c)); }, 1024);
    HexSmoothing result;
    result.min_before = worst();
    result.warpage_before = most_warped();
    for (const bool counts_warpage : {false, true}) {
      counts_warpage_ = counts_warpage;
      floor_ = std::max(options_.below_quality, worst());  // the grid's smallest does not fall for flatter faces
      quality_ = parallel_map(
          mesh_.cell_count(), [&](std::size_t c) { return quality_of(hex_corners(mesh_, c)); }, 1024);
      sweep(result);
    }
    result.min_after = worst();
    result.warpage_after = most_warped();
    return result;
  }

 private:
  void sweep(HexSmoothing& result) {
    // Only where cells changed can there be anything new to find.
    std::vector<char> is_waiting(mesh_.points.size(), 1);
    for (std::int64_t sweep = 0; sweep < options_.sweeps; ++sweep) {
      std::uint64_t moved = 0;
      for (const std::vector<std::uint32_t>& colour : colours_) {
        const std::vector<char> has_moved = parallel_map(
            colour.size(),
            [&](std::size_t i) -> char {
              const std::uint32_t v = colour[i];
              if (!is_waiting[v]) return 0;
              is_waiting[v] = 0;
              const Vec3 place = better_place(v);
              if (place == mesh_.points[v]) return 0;
              mesh_.points[v] = place;  // no other of this colour looks at it
              for (std::uint32_t k = first_[v]; k < first_[v + 1]; ++k)
                quality_[corners_[k] / 8] = quality_of(hex_corners(mesh_, corners_[k] / 8));
              return 1;
            },
            64);
        for (std::size_t i = 0; i < colour.size(); ++i) {
          if (!has_moved[i]) continue;
          ++moved;
          for (std::uint32_t k = first_[colour[i]]; k < first_[colour[i] + 1]; ++k)
            for (std::uint32_t c = 0; c < 8; ++c) is_waiting[mesh_.cell_vertices[corners_[k] / 8 * 8 + c]] = 1;
        }
      }
      ++result.sweeps;
      result.moves += moved;
      if (moved == 0) break;
    }
  }

  bool has_volume(std::size_t cell) const { return is_full_[cell] != 0; }

  CellQuality quality_of(const std::array<Vec3, 8>& corners) const {
    const double jacobian = scaled_jacobian(corners);
    if (!counts_warpage_) return {jacobian, jacobian};
    const double warped = face_warpage_m(corners) / (warped_ratio * edge_m_);
    return {jacobian, warped > 1 ? std::min(jacobian, options_.below_quality / warped) : jacobian};
  }

  void find_cells_around() {
    first_.assign(mesh_.points.size() + 1, 0);
    for (const std::uint32_t v : mesh_.cell_vertices) ++first_[v + 1];
    for (std::size_t v = 0; v < mesh_.points.size(); ++v) first_[v + 1] += first_[v];
    corners_.resize(mesh_.cell_vertices.size());
    std::vector<std::uint32_t> next = first_;
    for (std::uint32_t i = 0; i < mesh_.cell_vertices.size(); ++i) corners_[next[mesh_.cell_vertices[i]]++] = i;
    is_full_ = parallel_map(
        mesh_.cell_count(),
        [&](std::size_t c) -> char {
          const std::array<Vec3, 8> p = hex_corners(mesh_, c);
          for (std::size_t k = 0; k < 4; ++k)
            if (!(length(p[4 + k] - p[k]) > 0)) return 0;
          return 1;
        },
        1024);
  }

  /// Per vertex: −2 fixed, −1 free, otherwise the entity it slides on.
  void find_freedom() {
    constexpr double touching_ratio = 1e-6;  // of the mean edge: further off, a vertex is not on its horizon
    freedom_.assign(mesh_.points.size(), -1);
    std::vector<char> is_on_feature(hexes_.grid.plan.points.size(), 0);
    for (const FeatureEdge& edge : hexes_.grid.plan.edges) is_on_feature[edge.a] = is_on_feature[edge.b] = 1;
    for (std::size_t c = 0; c < mesh_.cell_count(); ++c)
      for (std::size_t k = 0; k < 8; ++k)
        if (!has_volume(c) || is_on_feature[hexes_.grid.plan.quads[hexes_.grid.cell_column[c]][k % 4]])
          freedom_[mesh_.cell_vertices[8 * c + k]] = -2;
    for (const MeshFacet& facet : mesh_.facets) {
      const auto entity = static_cast<std::int32_t>(facet.surface);
      for (const std::uint32_t v : facet.vertices) {
        if (v == no_index) continue;
        std::int32_t& freedom = freedom_[v];
        freedom = freedom == -1 || freedom == entity ? entity : -2;
      }
    }
    surfaces_.resize(space_.model.entities.size());
    for (const SheetFacet& facet : space_.model.facets)
      if (facet.kind != SheetKind::fault) surfaces_[facet.entity].triangles.push_back(facet.vertices);
    std::vector<char> is_asked(surfaces_.size(), 0);
    for (const std::int32_t freedom : freedom_)
      if (freedom >= 0) is_asked[static_cast<std::size_t>(freedom)] = 1;
    for (std::size_t e = 0; e < surfaces_.size(); ++e)
      if (is_asked[e] && !surfaces_[e].triangles.empty())
        surfaces_[e].nearest =
            std::make_unique<NearestTriangle>(TriangleMesh{space_.model.points, surfaces_[e].triangles});
    freedom_ = parallel_map(
        freedom_.size(),
        [&](std::size_t v) {
          if (freedom_[v] < 0) return freedom_[v];
          if (!surfaces_[static_cast<std::size_t>(freedom_[v])].nearest)
            return -2;  // a fault beside the plan's: stairs
          const Vec3& at = mesh_.points[v];
          const bool is_off = length(held(static_cast<std::uint32_t>(v), at) - at) > touching_ratio * edge_m_;
          return is_off ? -1 : freedom_[v];
        },
        256);
  }

  /// Vertices of one colour share no cell.
  void find_colours() {
    std::vector<std::uint32_t> colour(mesh_.points.size(), no_index), taken_by;  // per colour: last vertex beside it
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      if (freedom_[v] == -2) continue;
      for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i)
        for (std::uint32_t k = 0; k < 8; ++k) {
          const std::uint32_t other = colour[mesh_.cell_vertices[corners_[i] / 8 * 8 + k]];
          if (other != no_index) taken_by[other] = v;
        }
      std::uint32_t mine = 0;
      while (mine < taken_by.size() && taken_by[mine] == v) ++mine;
      if (mine == taken_by.size()) taken_by.push_back(no_index);
      colour[v] = mine;
      if (colours_.size() <= mine) colours_.resize(mine + 1);
      colours_[mine].push_back(v);
    }
  }

  /// The worst of the cells around with v at `place`; stops as soon as it is not better than `than`, or the Jacobian
  /// below `floor`: nothing then.
  std::optional<CellQuality> better_at(std::uint32_t v, const Vec3& place, double than, double floor) const {
    CellQuality least;
    for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
      std::array<Vec3, 8> p = hex_corners(mesh_, corners_[i] / 8);
      p[corners_[i] % 8] = place;
      const CellQuality quality = quality_of(p);
      // None is turned over for the sake of others.
      if (!(quality.jacobian > 0) && quality_[corners_[i] / 8].jacobian > 0) return std::nullopt;
      least.take(quality);
      if (!(least.shape > than && least.jacobian >= floor)) return std::nullopt;
    }
    return least;
  }

  Vec3 held(std::uint32_t v, const Vec3& place) const {
    if (freedom_[v] < 0) return place;
    const Surface& surface = surfaces_[static_cast<std::size_t>(freedom_[v])];
    const Triangle& t = surface.triangles[surface.nearest->nearest(place).triangle];
    return nearest_point(place, space_.model.points[t[0]], space_.model.points[t[1]], space_.model.points[t[2]]);
  }

  /// The best of: some way to the mean of the neighbours, and a little along each edge.
  Vec3 better_place(std::uint32_t v) const {
    const Vec3 from = mesh_.points[v];
    CellQuality best;
    for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i) best.take(quality_[corners_[i] / 8]);
    if (best.shape >= options_.below_quality) return from;
    const double floor = std::min(best.jacobian, floor_);
    std::vector<std::uint32_t> ends;
    for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i)
      for (const CornerFrame& frame : shape_of(CellType::hexahedron).corners)
        if (frame.corner == corners_[i] % 8)
          for (const std::uint8_t end : frame.ends) ends.push_back(mesh_.cell_vertices[corners_[i] / 8 * 8 + end]);
    ends = sorted_unique(std::move(ends));
    Vec3 mean;
    for (const std::uint32_t end : ends) mean = mean + (1.0 / static_cast<double>(ends.size())) * mesh_.points[end];
    Vec3 place = from;
    const auto offer = [&](const Vec3& candidate) {
      const Vec3 at = held(v, candidate);
      const std::optional<CellQuality> quality = better_at(v, at, best.shape + 1e-9, floor);
      if (!quality) return;
      best = *quality;
      place = at;
    };
    for (const double share : {1.0, 0.5, 0.25}) offer(from + share * (mean - from));
    for (const std::uint32_t end : ends)
      for (const double share : {0.2, 0.05, -0.05}) offer(from + share * (mesh_.points[end] - from));
    return place;
  }

  double worst() const {
    double least = quality_.empty() ? 0 : 1;
    for (std::size_t c = 0; c < quality_.size(); ++c)
      if (has_volume(c)) least = std::min(least, quality_[c].jacobian);
    return least;
  }

  double most_warped() const {
    const std::vector<double> warped = parallel_map(
        mesh_.cell_count(), [&](std::size_t c) { return has_volume(c) ? face_warpage_m(hex_corners(mesh_, c)) : 0.0; },
        1024);
    return warped.empty() ? 0 : *std::max_element(warped.begin(), warped.end()) / edge_m_;
  }

  struct Surface {
    std::vector<Triangle> triangles;
    std::unique_ptr<NearestTriangle> nearest;
  };

  VolumeMesh& mesh_;
  const ExtrudedHexes& hexes_;
  const LayeredSpace& space_;
  const SmoothHexesOptions& options_;
  double edge_m_ = 1;
  bool counts_warpage_ = false;
  double floor_ = 0;
  std::vector<std::uint32_t> first_, corners_;  // per vertex: 8·cell + corner
  std::vector<char> is_full_;                   // per cell: no vertical edge without length
  std::vector<CellQuality> quality_;            // per cell
  std::vector<std::int32_t> freedom_;
  std::vector<Surface> surfaces_;  // per entity
  std::vector<std::vector<std::uint32_t>> colours_;
};

}  // namespace

double face_warpage_m(const std::array<Vec3, 8>& corners) {
  double most = 0;
  for (const LocalFace& face : shape_of(CellType::hexahedron).faces) {
    const Vec3 &a = corners[face[0]], &b = corners[face[1]], &c = corners[face[2]], &d = corners[face[3]];
    const Vec3 n = cross(c - a, d - b);
    // From the mean plane all four are equally far.
    if (const double area = length(n); area > 0) most = std::max(most, std::abs(dot(n, a - b + c - d)) / (4 * area));
  }
  return most;
}

double scaled_jacobian(const std::array<Vec3, 8>& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (const CornerFrame& frame : shape_of(CellType::hexahedron).corners) {
    const Vec3 a = corners[frame.ends[0]] - corners[frame.corner], b = corners[frame.ends[1]] - corners[frame.corner],
               c = corners[frame.ends[2]] - corners[frame.corner];
    const double lengths = length(a) * length(b) * length(c);
    least = std::min(least, lengths > 0 ? dot(a, cross(b, c)) / lengths : 0.0);
  }
  return least;
}

Result<HexSmoothing> smooth_hexes(ExtrudedHexes& hexes, const LayeredSpace& space, const SmoothHexesOptions& options) {
  if (options.sweeps < 0 || !(options.below_quality >= 0 && options.below_quality <= 1))
    return Failure{FailureCode::invalid_options, "sweeps must be ≥ 0 and below_quality in [0, 1]", "use 10 and 0.6"};
  const HexSmoothing result = HexSmoother(hexes, space, options).smooth();
  judge_cells(hexes);
  return result;
}

}  // namespace strataflow
