#include "kernels/quads/extraction/extract_quads.h"

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>

#include "base/id.h"
#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/extraction/grid_graph.h"
#include "kernels/quads/extraction/grid_map.h"
#include "kernels/quads/plan/plane_geometry.h"

namespace strataflow {

namespace {

Failure not_quads(const std::string& what) {
  return Failure{FailureCode::geometry_failed, what, "this map cannot be turned into quads; try another edge length"};
}

class QuadExtraction {
 public:
  QuadExtraction(const FeatureMesh& mesh, const CornerMap& map, const GridMap& exact, const GridGraph& graph)
      : mesh_(mesh), map_(map), exact_(exact), graph_(graph) {
    for (std::uint32_t h = 0; h < exact.opposite.size(); ++h)
      is_free_ = is_free_ || (exact.opposite[h] == no_index && map.axes[h] == MapAxis::none);
  }

  Result<void> run() {
    quads_.local_origin = mesh_.local_origin;
    quads_.features = mesh_.features;
    quads_.changes = mesh_.changes;
    if (const auto failure = check_turns()) return *failure;
    if (const auto failure = find_cells()) return *failure;
    if (quads_.quads.empty()) return not_quads("the map has no whole quad");
    if (is_free_) trim();
    if (const auto failure = find_features()) return *failure;
    compact();
    const Result<void> manifold = check_quads(quads_);
    if (!manifold) return manifold.failure();
    if (const auto failure = check_topology()) return *failure;
    return {};
  }

  void take(QuadsOnGrid& out) {
    out.quads = std::move(quads_);
    out.vertex_of = std::move(vertex_of_);
    out.first_port = std::move(first_port_);
  }

 private:
  std::string place(const Vec3& p) const { return place_text(p, mesh_.local_origin); }

  /// The next step around the cell to the left; no_index outside.
  std::uint32_t next_step(std::uint32_t port) const {
    const std::uint32_t back = graph_.partner[port];
    if (back == no_index) return no_index;
    const std::uint32_t v = graph_.ports[back].vertex, first = graph_.first_port[v];
    if (back > first) return back - 1;
    return graph_.is_on_boundary[v] ? no_index : graph_.first_port[v + 1] - 1;
  }

  /// Around points inside, the map must turn as often as the field says: a map without flipped triangles can still
  /// miss whole turns.
  std::optional<Failure> check_turns() const {
    if (map_.valence.size() != mesh_.points.size()) return std::nullopt;
    for (std::uint32_t p = 0; p < mesh_.points.size(); ++p) {
      const std::uint32_t v = graph_.at_point[p];
      if (v == no_index || graph_.is_on_boundary[v]) continue;
      const std::uint32_t steps = graph_.first_port[v + 1] - graph_.first_port[v];
      if (steps != static_cast<std::uint32_t>(map_.valence[p]))
        return not_quads("the map has " + std::to_string(steps) + " quads around the point at " +
                         place(mesh_.points[p]) + ", the field wants " + std::to_string(map_.valence[p]));
    }
    return std::nullopt;
  }

  std::optional<Failure> find_cells() {
    std::vector<char> is_used(graph_.ports.size(), 0);
    for (std::uint32_t p = 0; p < graph_.ports.size(); ++p) {
      if (is_used[p]) continue;
      std::array<std::uint32_t, 4> cell{};
      std::uint32_t at = p;
      int count = 0;
      for (; count < 4 && at != no_index; ++count) {
        cell[static_cast<std::size_t>(count)] = graph_.ports[at].vertex;
        at = next_step(at);
      }
      if (at == no_index) {
        const std::uint32_t v = graph_.ports[p].vertex;
        if (is_free_ || (graph_.partner[p] != no_index && graph_.is_on_boundary[v])) continue;
        return not_quads("a cell of the grid is open at " + place(graph_.positions[v]));
      }
      if (at != p) return not_quads("a cell of the grid is no quad at " + place(graph_.positions[cell[0]]));
      for (count = 0; count < 4; ++count, at = next_step(at)) is_used[at] = 1;
      quads_.quads.push_back(cell);
      first_port_.push_back(p);
    }
    return std::nullopt;
  }

  /// Leaves out quads that hang on by a point only, until the rest is a manifold.
  void trim() {
    quads_.points = graph_.positions;
    const std::size_t before = quads_.quads.size();
    for (bool any = true; any;) {
      any = false;
      std::vector<std::array<std::uint32_t, 2>> sides;
      for (const auto& quad : quads_.quads)
        for (std::size_t k = 0; k < 4; ++k) sides.push_back({quad[k], quad[(k + 1) % 4]});
      std::sort(sides.begin(), sides.end());
      std::vector<std::uint32_t> open(graph_.vertices.size(), 0);
      for (const auto& s : sides)
        if (!std::binary_search(sides.begin(), sides.end(), std::array<std::uint32_t, 2>{s[1], s[0]})) ++open[s[0]];
      std::size_t kept = 0;
      for (std::size_t q = 0; q < quads_.quads.size(); ++q) {
        const auto& quad = quads_.quads[q];
        if (std::any_of(quad.begin(), quad.end(), [&](std::uint32_t p) { return open[p] > 1; })) continue;
        first_port_[kept] = first_port_[q];
        quads_.quads[kept++] = quad;
      }
      any = kept < quads_.quads.size();
      quads_.quads.resize(kept);
      first_port_.resize(kept);
    }
    if (before > quads_.quads.size())
      quads_.changes.push_back({"trimmed", std::to_string(before - quads_.quads.size()) + " quads",
                                "they hang on by a corner at the free boundary"});
    quads_.points.clear();
  }

  std::uint32_t end_of(std::uint32_t h) const { return mesh_.triangles[h / 3][GridMap::next(h) % 3]; }

  bool has_side(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(sides_.begin(), sides_.end(),
                              std::array<std::uint32_t, 2>{std::min(a, b), std::max(a, b)});
  }

  std::optional<Failure> find_features() {
    for (const auto& quad : quads_.quads)
      for (std::size_t k = 0; k < 4; ++k)
        sides_.push_back({std::min(quad[k], quad[(k + 1) % 4]), std::max(quad[k], quad[(k + 1) % 4])});
    std::sort(sides_.begin(), sides_.end());
    for (std::uint32_t f = 0; f < mesh_.features.size(); ++f)
      for (const auto& chain : feature_chains(mesh_.edges, mesh_.corners, f))
        if (const auto failure = cover(f, chain)) return failure;
    std::sort(quads_.edges.begin(), quads_.edges.end());
    return std::nullopt;
  }

  /// Labels the quad edges along one chain of a feature's mesh edges.
  std::optional<Failure> cover(std::uint32_t f, const std::vector<std::uint32_t>& chain) {
    std::vector<std::uint32_t> on;  // vertices along the chain
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const std::uint32_t h = exact_.half_edge_between(mesh_, chain[i], chain[i + 1]);
      if (h == no_index)
        return not_quads("\"" + mesh_.features[f].name + "\" leaves the mesh at " + place(mesh_.points[chain[i]]));
      if (graph_.at_point[chain[i]] != no_index) on.push_back(graph_.at_point[chain[i]]);
      const std::uint32_t g = exact_.opposite[h], owner = g != no_index && g < h ? g : h;
      const auto first = graph_.first_on_edge[owner], end = graph_.first_on_edge[owner + 1];
      const bool is_forward = mesh_.triangles[owner / 3][owner % 3] == chain[i];
      for (std::uint32_t k = 0; k < end - first; ++k) on.push_back(is_forward ? first + k : end - 1 - k);
    }
    const bool is_closed = chain.front() == chain.back();
    if (!is_closed && graph_.at_point[chain.back()] != no_index) on.push_back(graph_.at_point[chain.back()]);
    if (is_closed && !on.empty()) on.push_back(on.front());
    const auto missing = [&](const Vec3& p) {
      return not_quads("\"" + mesh_.features[f].name + "\" is no chain of quad edges at " + place(p));
    };
    if (!is_free_ && !is_closed)
      for (const std::uint32_t p : {chain.front(), chain.back()})
        if (graph_.at_point[p] == no_index) return missing(mesh_.points[p]);
    if (!is_free_ && on.size() < 2) return missing(mesh_.points[chain.front()]);
    for (std::size_t i = 0; i + 1 < on.size(); ++i) {
      if (has_side(on[i], on[i + 1])) {
        quads_.edges.push_back({std::min(on[i], on[i + 1]), std::max(on[i], on[i + 1]), f});
      } else if (!is_free_) {
        return missing(graph_.positions[on[i]]);
      }
    }
    return std::nullopt;
  }

  void compact() {
    std::vector<std::uint32_t> number(graph_.vertices.size(), no_index);
    for (const auto& quad : quads_.quads)
      for (const std::uint32_t v : quad) number[v] = 0;
    for (std::uint32_t v = 0; v < number.size(); ++v) {
      if (number[v] == no_index) continue;
      number[v] = static_cast<std::uint32_t>(quads_.points.size());
      quads_.points.push_back(graph_.positions[v]);
      vertex_of_.push_back(v);
    }
    for (auto& quad : quads_.quads)
      for (std::uint32_t& v : quad) v = number[v];
    for (FeatureEdge& e : quads_.edges) {
      e.a = number[e.a];
      e.b = number[e.b];
    }
    for (const std::uint32_t p : mesh_.corners)
      quads_.corner_points.push_back(graph_.at_point[p] == no_index ? no_index : number[graph_.at_point[p]]);
  }

  std::optional<Failure> check_topology() const {
    if (is_free_) return std::nullopt;
    const std::int64_t wanted = euler_characteristic(mesh_.points.size(), mesh_.triangles);
    const std::int64_t got = euler_characteristic(quads_.points.size(), quads_.quads);
    if (wanted != got)
      return not_quads("the quads have the Euler characteristic " + std::to_string(got) + ", the surface " +
                       std::to_string(wanted));
    for (std::size_t i = 0; i < mesh_.corners.size(); ++i)
      if (quads_.corner_points[i] == no_index)
        return not_quads("no quad has the required point " + place(mesh_.points[mesh_.corners[i]]));
    if (map_.valence.size() != mesh_.points.size()) return std::nullopt;
    const auto valence = quad_valence(quads_);
    const auto is_boundary = boundary_points(quads_);
    for (std::uint32_t p = 0; p < quads_.points.size(); ++p) {
      const GridGraph::Vertex& vertex = graph_.vertices[vertex_of_[p]];
      const bool at_point = vertex.place == GridGraph::Place::point;
      const auto wish = at_point ? static_cast<std::uint32_t>(map_.valence[vertex.element]) : is_boundary[p] ? 2u : 4u;
      if (valence[p] != wish)
        return not_quads("the vertex at " + place(quads_.points[p]) + " has " + std::to_string(valence[p]) +
                         " quads, the field wants " + std::to_string(wish));
    }
    for (std::uint32_t p = 0; p < mesh_.points.size(); ++p) {
      const std::uint32_t h = exact_.first_out[p];
      if (h != no_index && exact_.opposite[h] != no_index && map_.valence[p] != 4 && graph_.at_point[p] == no_index)
        return not_quads("the singular point at " + place(mesh_.points[p]) + " is no vertex");
    }
    return std::nullopt;
  }

  const FeatureMesh& mesh_;
  const CornerMap& map_;
  const GridMap& exact_;
  const GridGraph& graph_;
  bool is_free_ = false;
  QuadMesh quads_;
  std::vector<std::array<std::uint32_t, 2>> sides_;  ///< of quads, ascending inside and between
  std::vector<std::uint32_t> vertex_of_;             ///< per point of quads_
  std::vector<std::uint32_t> first_port_;            ///< per quad
};

}  // namespace

Result<QuadsOnGrid> extract_quads_on_grid(const FeatureMesh& mesh, const CornerMap& map) {
  Result<GridMap> exact = exact_grid_map(mesh, map);
  if (!exact) return exact.failure();
  Result<GridGraph> graph = trace_grid(mesh, *exact);
  if (!graph) return graph.failure();
  QuadsOnGrid out;
  QuadExtraction extraction(mesh, map, *exact, *graph);
  if (const Result<void> done = extraction.run(); !done) return done.failure();
  extraction.take(out);
  out.map = std::move(*exact);
  out.graph = std::move(*graph);
  return out;
}

Result<QuadMesh> extract_quads(const FeatureMesh& mesh, const CornerMap& map) {
  Result<QuadsOnGrid> out = extract_quads_on_grid(mesh, map);
  if (!out) return out.failure();
  return std::move(out->quads);
}

}  // namespace strataflow
