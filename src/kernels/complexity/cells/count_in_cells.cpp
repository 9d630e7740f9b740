#include "kernels/complexity/cells/count_in_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/complexity/principal_axes.h"
#include "kernels/topology/query_model.h"
#include "kernels/topology/sorted_unique.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {

constexpr std::size_t grain = 64;  ///< cells

/// How many sets remain when members that share a key are joined.
std::uint32_t joined_count(std::size_t members, std::vector<std::pair<std::uint64_t, std::uint32_t>>& keys) {
  std::sort(keys.begin(), keys.end());
  UnionFind sets(members);
  auto left = static_cast<std::uint32_t>(members);
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i].first == keys[i - 1].first && sets.find(keys[i].second) != sets.find(keys[i - 1].second)) {
      sets.unite(keys[i].second, keys[i - 1].second);
      --left;
    }
  return left;
}

/// What is known of the model's triangles and lines before any cell is looked at.
class CellCounter {
 public:
  CellCounter(const StructuralModel& model, const BoxElements& box, const GeometricSamples& samples,
              const GeometricComplexity& geometric, const CellPieces& pieces, CountBy by)
      : model_(model),
        box_(box),
        edges_(samples.edges),
        pieces_(pieces),
        by_(by),
        queries_(model),
        is_line_(line_of_edges(model, samples.edges)),
        thin_(model.triangles.size(), 0),
        surface_edge_m_(model.surfaces.size(), std::numeric_limits<double>::infinity()),
        line_edge_m_(model.lines.size(), std::numeric_limits<double>::infinity()),
        thickness_m_(model.triangles.size(), std::numeric_limits<double>::infinity()),
        first_edge_(model.lines.size() + 1, 0) {
    std::vector<double> area(model.triangles.size(), 0);
    for (const ThicknessSample& sample : samples.thickness.samples) {
      area[sample.triangle] += sample.area_m2;
      if (!(sample.thickness_m < geometric.edge_length_m)) continue;
      thin_[sample.triangle] += sample.area_m2;
      if (sample.is_wedge == 0)
        thickness_m_[sample.triangle] = std::min(thickness_m_[sample.triangle], sample.thickness_m);
    }
    for (std::size_t t = 0; t < area.size(); ++t) thin_[t] = area[t] > 0 ? thin_[t] / area[t] : 0;
    for (const ElementComplexity& one : geometric.elements) {
      if (one.type == ElementType::surface) surface_edge_m_[one.element] = std::sqrt(one.size);
      if (one.type == ElementType::line) line_edge_m_[one.element] = one.size;
    }
    for (std::size_t l = 0; l < model.lines.size(); ++l)
      first_edge_[l + 1] = first_edge_[l] + static_cast<std::uint32_t>(model.lines[l].vertices.size());
    is_sharp_.assign(first_edge_.back(), 0);
    for (const ContactWedge& wedge : samples.wedges)
      if (wedge.region != universe && wedge.angle_deg < geometric.angle_deg)
        is_sharp_[first_edge_[wedge.line] + wedge.edge] = 1;
  }

  CellCount count(std::size_t cell) const {
    CellCount count;
    count.needed_edge_m = pieces_.resolution_m;
    count_surfaces(cell, count);
    if (count.regions == 0) count_regions_without_surfaces(cell, count);
    count_lines(cell, count);
    for (const std::uint32_t corner : pieces_.corners_in(cell)) count.corners += box_.corners[corner] == 0;
    if (by_ == CountBy::features) count.lines = count.corners = 0;
    return count;
  }

 private:
  void count_surfaces(std::size_t cell, CellCount& count) const {
    std::vector<std::uint32_t> surfaces, regions;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
    Symmetric3 normals{};
    double thin_m2 = 0;
    std::uint32_t members = 0;
    for (const SurfacePiece& piece : pieces_.surfaces_in(cell)) {
      const std::uint32_t t = piece.triangle, s = model_.triangle_surface[t];
      if (box_.surfaces[s] != 0) continue;
      surfaces.push_back(s);
      for (const std::uint32_t region : {model_.surfaces[s].region_plus, model_.surfaces[s].region_minus})
        if (region != universe) regions.push_back(region);
      for (std::uint32_t k = 0; k < 3; ++k)
        if (const std::uint32_t e = edges_.edge_of[3 * t + k]; (piece.edges >> k & 1) != 0) {
          if (by_ == CountBy::features)
            keys.emplace_back(std::uint64_t{model_.surfaces[s].entity} << 32 | e, members);
          else if (is_line_[e] == no_index)
            keys.emplace_back(e, members);
        }
      ++members;
      count.area_m2 += piece.area_m2;
      thin_m2 += thin_[t] * piece.area_m2;
      count.needed_edge_m = std::min({count.needed_edge_m, thickness_m_[t], surface_edge_m_[s]});
      const Vec3 n = normal_of(t);
      const Symmetric3 more = outer_product(n, n, piece.area_m2);
      for (std::size_t i = 0; i < 6; ++i) normals[i] += more[i];
    }
    if (members == 0) return;
    surfaces = sorted_unique(std::move(surfaces));
    count.regions = static_cast<std::uint32_t>(sorted_unique(std::move(regions)).size());
    count.surfaces =
        by_ == CountBy::elements ? static_cast<std::uint32_t>(surfaces.size()) : joined_count(members, keys);
    if (!(count.area_m2 > 0)) return;
    count.thin_ratio = thin_m2 / count.area_m2;
    const Vec3 mean = principal_axes(normals).axes[0];
    double projected = 0;
    for (const SurfacePiece& piece : pieces_.surfaces_in(cell))
      if (box_.surfaces[model_.triangle_surface[piece.triangle]] == 0)
        projected += piece.area_m2 * std::abs(dot(normal_of(piece.triangle), mean));
    count.roughness_ratio = std::clamp(1 - projected / count.area_m2, 0.0, 1.0);
  }

  void count_regions_without_surfaces(std::size_t cell, CellCount& count) const {
    if (queries_.region_at(pieces_.sites[cell]) != universe) {
      count.regions = 1;
      return;
    }
    std::vector<std::uint32_t> regions;  // the cell sticks out of the box
    for (const SurfacePiece& piece : pieces_.surfaces_in(cell)) {
      const Surface& surface = model_.surfaces[model_.triangle_surface[piece.triangle]];
      for (const std::uint32_t region : {surface.region_plus, surface.region_minus})
        if (region != universe) regions.push_back(region);
    }
    count.regions = static_cast<std::uint32_t>(sorted_unique(std::move(regions)).size());
  }

  void count_lines(std::size_t cell, CellCount& count) const {
    std::vector<std::uint32_t> lines;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
    double sharp_m = 0;
    std::uint32_t members = 0;
    for (const LinePiece& piece : pieces_.lines_in(cell)) {
      if (box_.lines[piece.line] != 0) continue;
      lines.push_back(piece.line);
      const std::uint64_t line = std::uint64_t{piece.line} << 32;
      const Line& whole = model_.lines[piece.line];
      if ((piece.ends & 1) != 0) keys.emplace_back(line | piece.edge, members);
      if ((piece.ends & 2) != 0) {
        const std::uint32_t next = piece.edge + 1;
        keys.emplace_back(line | (whole.is_closed() && next == whole.vertices.size() ? 0 : next), members);
      }
      ++members;
      count.length_m += piece.length_m;
      if (is_sharp_[first_edge_[piece.line] + piece.edge] != 0) sharp_m += piece.length_m;
      count.needed_edge_m = std::min(count.needed_edge_m, line_edge_m_[piece.line]);
    }
    if (members == 0) return;
    count.lines = by_ == CountBy::components ? joined_count(members, keys)
                                             : static_cast<std::uint32_t>(sorted_unique(std::move(lines)).size());
    count.sharp_ratio = count.length_m > 0 ? sharp_m / count.length_m : 0;
  }

  Vec3 normal_of(std::uint32_t t) const {
    const auto [i, j, k] = model_.triangles[t];
    const Vec3 n = cross(model_.points[j] - model_.points[i], model_.points[k] - model_.points[i]);
    const double size = length(n);
    return size > 0 ? (1 / size) * n : Vec3{};
  }

  const StructuralModel& model_;
  const BoxElements& box_;
  const EdgeTable& edges_;
  const CellPieces& pieces_;
  CountBy by_;
  ModelQueries queries_;
  std::vector<std::uint32_t> is_line_;  ///< per edge: its line, or no_index
  std::vector<double> thin_;            ///< per triangle: share of it over less than h
  std::vector<double> surface_edge_m_, line_edge_m_, thickness_m_;
  std::vector<std::uint32_t> first_edge_;  ///< per line: where its edges start in is_sharp_
  std::vector<char> is_sharp_;
};

}  // namespace

std::vector<CellCount> count_in_cells(const StructuralModel& model, const BoxElements& box,
                                      const GeometricSamples& samples, const GeometricComplexity& geometric,
                                      const CellPieces& pieces, CountBy by) {
  const CellCounter counter(model, box, samples, geometric, pieces, by);
  return parallel_map(pieces.cell_count(), [&](std::size_t cell) { return counter.count(cell); }, grain);
}

CellStatistics statistics_of(const std::vector<CellCount>& counts, double resolution_m) {
  CellStatistics result;
  result.resolution_m = resolution_m;
  std::vector<std::uint32_t> totals;
  std::vector<double> needed;
  double sum = 0;
  for (const CellCount& count : counts) {
    if (count.regions == 0) continue;
    totals.push_back(count.total());
    needed.push_back(count.needed_edge_m);
    sum += count.total();
    result.above_6 += count.total() > 6;
  }
  result.cells = totals.size();
  if (totals.empty()) return result;
  std::sort(totals.begin(), totals.end());
  std::sort(needed.begin(), needed.end());
  const auto n = static_cast<double>(totals.size());
  const auto place = [&](double q) { return static_cast<std::size_t>(std::max(1.0, std::ceil(q * n))) - 1; };
  result.q10 = totals[place(0.1)];
  result.q50 = totals[place(0.5)];
  result.q90 = totals[place(0.9)];
  result.max = totals.back();
  result.mean = sum / n;
  double square = 0;
  for (const std::uint32_t total : totals) square += (total - result.mean) * (total - result.mean);
  result.cv = totals.size() > 1 ? std::sqrt(square / (n - 1)) / result.mean : 0;
  result.needed_edge_m = needed[place(0.01)];
  return result;
}

}  // namespace strataflow
