#include "kernels/cutting/cut_surfaces.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/id.h"
#include "base/internal_error.h"
#include "graph/parallel/parallel_map.h"
#include "graph/parallel/sort_total_order.h"
#include "kernels/cutting/cluster_points.h"
#include "kernels/cutting/cut_triangles.h"
#include "kernels/cutting/merge_coincident.h"
#include "kernels/cutting/repair_rounding.h"
#include "kernels/cutting/rounded_position.h"
#include "kernels/cutting/suspected_repeats.h"
#include "kernels/topology/building/weld_points.h"
#include "kernels/topology/sorted_unique.h"
#include "model/box3.h"

namespace strataflow {

namespace {

constexpr std::uint64_t most_rounds = 40;

class SurfaceCutter {
 public:
  SurfaceCutter(const TriangleSoup& soup, const CutSurfacesOptions& options) : soup_(soup), options_(options) {}

  Result<CutResult> run() {
    if (auto ok = read_names(); !ok) return ok.failure();
    weld();
    const std::uint64_t dropped_before = result_.report.dropped_triangles;
    std::uint64_t& pairs_before = result_.report.intersecting_pairs;
    std::vector<IntersectingPair> pairs = wanted(find_intersections(mesh_.points, mesh_.triangles), &pairs_before);
    if (pairs_before == 0 && result_.report.merged_points == 0 && dropped_before == 0 && !any_snapped_) {
      result_.soup = soup_;  // records of the file are still true
      return std::move(result_);
    }
    while (!pairs.empty() && result_.report.rounds < most_rounds) {
      // After the first round what is left was made by rounding.
      if (++result_.report.rounds == 1 || !repair(pairs))
        if (auto ok = cut(pairs); !ok) return ok.failure();
      drop_flat();
      drop_repeated();
      pairs = wanted(find_intersections_of(mesh_.points, mesh_.triangles, mesh_.is_changed));
    }
    result_.report.pairs_left = pairs.size();
    tell();
    write_soup();
    return std::move(result_);
  }

 private:
  std::uint32_t entity_of(std::uint32_t t) const { return soup_.patch_entity[soup_.triangle_patch[mesh_.origin[t]]]; }

  Result<void> read_names() {
    const auto mark = [&](const std::vector<std::string>& names, std::vector<char>& marks) -> Result<void> {
      marks.assign(soup_.entities.size(), names.empty() ? 1 : 0);
      for (const std::string& name : names) {
        bool found = false;
        for (std::size_t e = 0; e < soup_.entities.size(); ++e)
          if (soup_.entities[e].name == name) {
            marks[e] = 1;
            found = true;
          }
        if (!found)
          return Failure{FailureCode::invalid_options, "no surface is called '" + name + "'",
                         "name surfaces as the input does; `strataflow check` lists them"};
      }
      return {};
    };
    if (auto ok = mark(options_.cut, is_cut_); !ok) return ok;
    return mark(options_.cutting, cuts_);
  }

  bool may_be_cut(std::uint32_t t) const { return options_.cut.empty() || is_cut_[entity_of(t)]; }

  /// Pairs that one of the two may cut the other in; identical triangles are but counted, for write_soup joins them. A
  /// piece that ends on a surface which must stay as it is touches it for good, give or take the rounding.
  std::vector<IntersectingPair> wanted(std::vector<IntersectingPair> pairs, std::uint64_t* count = nullptr) const {
    if (!options_.cut.empty() || !options_.cutting.empty())
      std::erase_if(pairs, [&](const IntersectingPair& p) {
        const std::uint32_t a = entity_of(p.first), b = entity_of(p.second);
        if (!((is_cut_[a] && cuts_[b]) || (is_cut_[b] && cuts_[a]))) return true;
        const bool is_one_sided = !may_be_cut(p.first) || !may_be_cut(p.second);
        return is_one_sided && result_.report.rounds > 0;
      });
    if (count) *count = pairs.size();
    std::erase_if(pairs, [&](const IntersectingPair& p) {
      const Triangle &a = mesh_.triangles[p.first], &b = mesh_.triangles[p.second];
      return std::is_permutation(a.begin(), a.end(), b.begin());
    });
    return pairs;
  }

  void weld() {
    std::vector<Vec3> points = soup_.points;
    for (Vec3& p : points) {
      const Vec3 kept = snapped_to_file(p, soup_.local_origin);
      any_snapped_ = any_snapped_ || !(kept == p);
      p = kept;
    }
    if (options_.tolerance_m > 0) {
      const PointClusters clusters = cluster_points(points, {}, options_.tolerance_m);
      take_merges(clusters);
      std::vector<Vec3> moved(points.size());
      for (std::size_t i = 0; i < points.size(); ++i) moved[i] = points[clusters.representative[i]];
      points = std::move(moved);
    }
    const WeldedPoints welded = weld_points(points);
    mesh_.points.resize(welded.source.size());
    for (std::size_t i = 0; i < welded.source.size(); ++i) mesh_.points[i] = points[welded.source[i]];
    mesh_.input_point_count = mesh_.points.size();
    mesh_.triangles.reserve(soup_.triangles.size());
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      const Triangle& v = soup_.triangles[t];
      mesh_.triangles.push_back({welded.id[v[0]], welded.id[v[1]], welded.id[v[2]]});
      mesh_.origin.push_back(t);
    }
    mesh_.is_changed.assign(mesh_.triangles.size(), 1);
    drop_flat();
    drop_repeated();
  }

  void take_merges(const PointClusters& clusters) {
    result_.report.merged_points += clusters.merged_count;
    result_.report.largest_move_m = std::max(result_.report.largest_move_m, clusters.largest_move_m);
  }

  /// Where dropped triangles count: as the input's fault, or as pieces that rounding made flat.
  std::uint64_t& drop_count() { return result_.report.rounds > 0 ? collapsed_ : result_.report.dropped_triangles; }

  /// Drops changed triangles of zero area: their neighbours are cut at the vertex that lies on the long edge.
  void drop_flat() {
    std::vector<char> is_kept = parallel_map(
        mesh_.triangles.size(),
        [&](std::size_t t) {
          return static_cast<char>(!mesh_.is_changed[t] || !is_degenerate(mesh_.points, mesh_.triangles[t]));
        },
        4096);
    // Those beside a dropped one must be looked at again: its vertex lies on their edge.
    std::vector<char> is_rim(mesh_.points.size(), 0);
    bool any = false;
    for (std::size_t t = 0; t < is_kept.size(); ++t)
      if (!is_kept[t]) {
        any = true;
        for (const std::uint32_t v : mesh_.triangles[t]) is_rim[v] = 1;
        ++drop_count();
      }
    if (!any) return;
    for (std::size_t t = 0; t < is_kept.size(); ++t)
      for (const std::uint32_t v : mesh_.triangles[t])
        if (is_rim[v]) mesh_.is_changed[t] = 1;
    mesh_.keep(is_kept);
  }

  /// Drops triangles whose vertices are those of an earlier one of the same entity. Two that look opposite ways are a
  /// fold without thickness, made by joining points: both go, and their neighbours meet.
  void drop_repeated() {
    struct Key {
      Triangle vertices;
      std::uint32_t entity, triangle;
      char is_turned;  ///< against ascending positions
    };
    std::vector<Key> keys;
    std::vector<char> is_touched(mesh_.points.size(), 0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (mesh_.is_changed[t])
        for (const std::uint32_t v : mesh_.triangles[t]) is_touched[v] = 1;
    std::vector<char> is_left_out(mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Triangle& v = mesh_.triangles[t];
      is_left_out[t] = !is_touched[v[0]] || !is_touched[v[1]] || !is_touched[v[2]];
    }
    for (const std::uint32_t t : suspected_repeats(mesh_.points.size(), mesh_.triangles, is_left_out)) {
      const Triangle& v = mesh_.triangles[t];
      Triangle sorted = v;
      std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
        return lexicographically_less(mesh_.points[a], mesh_.points[b]);
      });
      const bool is_turned =
          !(sorted == v || sorted == Triangle{v[1], v[2], v[0]} || sorted == Triangle{v[2], v[0], v[1]});
      keys.push_back({sorted, entity_of(t), t, static_cast<char>(is_turned)});
    }
    sort_total_order(keys, [](const Key& a, const Key& b) {
      return std::tie(a.vertices, a.entity, a.triangle) < std::tie(b.vertices, b.entity, b.triangle);
    });
    std::vector<char> is_kept(mesh_.triangles.size(), 1);
    bool any = false;
    for (std::size_t first = 0; first < keys.size();) {
      std::size_t end = first + 1;
      int balance = keys[first].is_turned ? -1 : 1;
      while (end < keys.size() && keys[end].vertices == keys[first].vertices && keys[end].entity == keys[first].entity)
        balance += keys[end++].is_turned ? -1 : 1;
      if (end - first > 1) {
        any = true;
        const bool is_fold = balance == 0 && result_.report.rounds > 0 && is_sliver(keys[first].vertices);
        std::size_t kept = is_fold ? end : first;  // one of the side most look to, however the input is numbered
        while (kept < end && keys[kept].is_turned != (balance < 0)) ++kept;
        for (std::size_t i = first; i < end; ++i) {
          if (i == kept) continue;
          is_kept[keys[i].triangle] = 0;
          ++drop_count();
        }
      }
      first = end;
    }
    if (any) mesh_.keep(is_kept);
  }

  /// Thinner than joining points can make it.
  bool is_sliver(const Triangle& t) const {
    const Vec3 &a = mesh_.points[t[0]], &b = mesh_.points[t[1]], &c = mesh_.points[t[2]];
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    const double height = length(cross(b - a, c - a)) / longest;
    return height <= std::max(4 * options_.intersection_tolerance_m, 1e-7 * longest);
  }

  Result<void> cut(const std::vector<IntersectingPair>& pairs) {
    CutReport& report = result_.report;
    std::vector<char> is_cuttable(options_.cut.empty() ? 0 : mesh_.triangles.size());
    for (std::uint32_t t = 0; t < is_cuttable.size(); ++t) is_cuttable[t] = may_be_cut(t);
    Result<TriangleCut> cut = cut_triangles(mesh_.points, mesh_.triangles, pairs, is_cuttable, soup_.local_origin);
    if (!cut) return cut.failure();
    if (report.rounds == 1) report.cut_triangles = cut->cut_triangle_count;
    for (std::uint32_t& s : cut->source) s = mesh_.origin[s];
    mesh_ = {std::move(cut->points), std::move(cut->triangles), std::move(cut->source), std::move(cut->is_piece),
             mesh_.input_point_count};
    collapsed_ += cut->collapsed_count;
    if (options_.intersection_tolerance_m > 0) merge_near_points();
    return {};
  }

  /// Points of intersection in reach of an input point, or of each other, become one.
  void merge_near_points() {
    std::vector<std::uint32_t> near;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (mesh_.is_changed[t]) near.insert(near.end(), mesh_.triangles[t].begin(), mesh_.triangles[t].end());
    near = sorted_unique(std::move(near));
    std::vector<Vec3> points;
    std::vector<char> is_fixed;
    for (const std::uint32_t v : near) {
      points.push_back(mesh_.points[v]);
      is_fixed.push_back(v < mesh_.input_point_count);
    }
    const PointClusters clusters = cluster_points(points, is_fixed, options_.intersection_tolerance_m);
    if (clusters.merged_count == 0) return;
    take_merges(clusters);
    std::vector<std::uint32_t> becomes(mesh_.points.size());
    std::iota(becomes.begin(), becomes.end(), 0u);
    for (std::size_t i = 0; i < near.size(); ++i) becomes[near[i]] = near[clusters.representative[i]];
    std::vector<char> is_kept(mesh_.triangles.size(), 1);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      Triangle& v = mesh_.triangles[t];
      const Triangle before = v;
      for (std::uint32_t& corner : v) corner = becomes[corner];
      if (v != before) mesh_.is_changed[t] = 1;
      if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) continue;
      is_kept[t] = 0;
      ++collapsed_;
    }
    mesh_.keep(is_kept);
  }

  /// Joins what rounding left a few units in the last place apart. The reach doubles each round, so it ends.
  bool repair(const std::vector<IntersectingPair>& pairs) {
    double largest = 0;
    for (const IntersectingPair& pair : pairs)
      for (const std::uint32_t v : mesh_.triangles[pair.first])
        for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(mesh_.points[v][axis]));
    CutReport& report = result_.report;
    const Vec3& o = soup_.local_origin;
    largest += std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)});
    const double reach = largest * std::ldexp(0x1.0p-51, static_cast<int>(std::min<std::uint64_t>(report.rounds, 24)));
    std::fill(mesh_.is_changed.begin(), mesh_.is_changed.end(), 0);
    // Pairs left alone stay to be looked at.
    for (const IntersectingPair& pair : pairs) mesh_.is_changed[pair.first] = mesh_.is_changed[pair.second] = 1;
    std::vector<IntersectingPair> mendable = pairs;
    std::erase_if(mendable, [&](const IntersectingPair& p) { return !may_be_cut(p.first) || !may_be_cut(p.second); });
    const RoundingRepair done = repair_rounding(mesh_, mendable, reach, o);
    report.merged_points += done.merged_points + done.split_edges + done.split_triangles;
    report.largest_move_m = std::max(report.largest_move_m, done.largest_move_m);
    return done.did_anything();
  }

  void tell() {
    CutReport& report = result_.report;
    std::vector<std::uint32_t> piece_count(soup_.triangles.size(), 0);
    for (const std::uint32_t origin : mesh_.origin) ++piece_count[origin];
    for (const std::uint32_t count : piece_count) report.pieces += count > 1 ? count : 0;
    const auto say = [&](const char* kind, std::uint64_t count, const std::string& what, const std::string& why) {
      if (count > 0) result_.changes.push_back({kind, std::to_string(count) + " " + what, why});
    };
    say("dropped_triangles", report.dropped_triangles, "triangles of zero area or given twice were dropped",
        "they bound nothing");
    say("merged_points", report.merged_points,
        "points became one with a neighbour, moving by at most " + std::to_string(report.largest_move_m) + " m",
        options_.tolerance_m > 0 || options_.intersection_tolerance_m > 0
            ? "they were nearer than the tolerance, or rounding had made them cross"
            : "rounding coordinates had made their triangles cross");
    say("collapsed_pieces", collapsed_, "pieces of triangles had no area after rounding and were dropped",
        "their corners round to one line");
  }

  /// Points are per patch where the input's points carry values: across a fault they differ.
  void write_soup() {
    TriangleSoup& out = result_.soup;
    out.local_origin = soup_.local_origin;
    out.entities = soup_.entities;
    const std::vector<std::uint32_t> patch_of = merge_coincident(mesh_, soup_, out, result_.changes);
    out.regions = soup_.regions;
    out.layers = soup_.layers;
    const bool has_values = !soup_.properties.empty();
    for (const PointProperty& p : soup_.properties) out.properties.push_back({p.name, p.unit, p.width, {}});
    std::vector<std::uint32_t> order(mesh_.triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    // Patch by patch, so that one marker per point is enough to find a patch's copy.
    if (has_values)
      std::stable_sort(order.begin(), order.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return patch_of[a] < patch_of[b]; });
    std::vector<std::uint32_t> copy(mesh_.points.size(), no_index), copy_patch(mesh_.points.size(), no_index);
    out.triangles.resize(mesh_.triangles.size());
    out.triangle_patch.resize(mesh_.triangles.size());
    std::vector<std::uint32_t> inserted;
    for (const std::uint32_t t : order) {
      const std::uint32_t origin = mesh_.origin[t], patch = patch_of[t];
      out.triangle_patch[t] = patch;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh_.triangles[t][k];
        if (copy[v] == no_index || (has_values && copy_patch[v] != patch)) {
          copy[v] = static_cast<std::uint32_t>(out.points.size());
          copy_patch[v] = patch;
          if (v >= mesh_.input_point_count) inserted.push_back(copy[v]);
          out.points.push_back(mesh_.points[v]);
          interpolate(origin, mesh_.points[v]);
        }
        out.triangles[t][k] = copy[v];
      }
    }
    mark_inserted(inserted);
    result_.report.new_points =
        mesh_.points.size() > mesh_.input_point_count ? mesh_.points.size() - mesh_.input_point_count : 0;
  }

  void mark_inserted(const std::vector<std::uint32_t>& inserted) {
    std::vector<PointProperty>& properties = result_.soup.properties;
    auto mark = std::find_if(properties.begin(), properties.end(),
                             [](const PointProperty& p) { return p.name == "inserted_by_cut" && p.width == 1; });
    if (mark == properties.end()) {
      if (!options_.mark_inserted) return;
      mark = properties.insert(mark, {"inserted_by_cut", "", 1, std::vector<double>(result_.soup.points.size(), 0)});
    }
    for (const std::uint32_t v : inserted) mark->values[v] = 1;
  }

  /// Appends the values at a point of an input triangle: linear between its corners.
  void interpolate(std::uint32_t origin, const Vec3& p) {
    if (soup_.properties.empty()) return;
    const Triangle& t = soup_.triangles[origin];
    const Vec3 &a = soup_.points[t[0]], &b = soup_.points[t[1]], &c = soup_.points[t[2]];
    const Vec3 normal = cross(b - a, c - a);
    const double area = dot(normal, normal);
    double weight[3] = {1, 0, 0};
    if (p == b)
      weight[0] = 0, weight[1] = 1;
    else if (p == c)
      weight[0] = 0, weight[2] = 1;
    else if (!(p == a) && area > 0) {
      weight[1] = std::clamp(dot(cross(p - a, c - a), normal) / area, 0.0, 1.0);
      weight[2] = std::clamp(dot(cross(b - a, p - a), normal) / area, 0.0, 1.0 - weight[1]);
      weight[0] = 1 - weight[1] - weight[2];
    }
    for (std::size_t i = 0; i < soup_.properties.size(); ++i) {
      const PointProperty& from = soup_.properties[i];
      for (std::uint32_t w = 0; w < from.width; ++w) {
        double value = 0;
        for (int k = 0; k < 3; ++k)
          if (weight[k] != 0) value += weight[k] * from.values[std::size_t{t[k]} * from.width + w];
        result_.soup.properties[i].values.push_back(value);
      }
    }
  }

  const TriangleSoup& soup_;
  const CutSurfacesOptions& options_;
  std::vector<char> is_cut_, cuts_;  ///< per entity
  CutMesh mesh_;
  bool any_snapped_ = false;
  std::uint64_t collapsed_ = 0;
  CutResult result_;
};

}  // namespace

Result<CutResult> cut_surfaces(const TriangleSoup& soup, const CutSurfacesOptions& options) {
  for (const PointProperty& property : soup.properties)
    STRATAFLOW_ASSERT(property.values.size() == soup.points.size() * property.width,
                      "property " + property.name + " does not have a value for every point");
  return SurfaceCutter(soup, options).run();
}

}  // namespace strataflow
