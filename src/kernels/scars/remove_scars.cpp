#include "kernels/scars/remove_scars.h"

#include <algorithm>

#include "base/id.h"
#include "kernels/scars/drop_unused_points.h"
#include "kernels/scars/suture.h"
#include "kernels/topology/building/weld_points.h"

namespace strataflow {

namespace {

std::optional<Failure> check(const TriangleSoup& soup, const ScarMarks& marks) {
  const auto fits = [&](std::size_t size) { return size == 0 || size == soup.points.size(); };
  if (!fits(marks.inserted_by_cut.size()) || !fits(marks.original_edge.size()))
    return Failure{FailureCode::invalid_input, "marks of a cut are given for another number of points",
                   "give one per point, or none"};
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const Triangle& v = soup.triangles[t];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
      return Failure{FailureCode::invalid_input,
                     "surface '" + soup.entities[soup.patch_entity[soup.triangle_patch[t]]].name +
                         "' has a triangle with a repeated point",
                     "drop such triangles first; `strataflow check --repair` does"};
  }
  return std::nullopt;
}

/// Per point: another point at its position is in use, or its own triangles belong to several entities.
std::vector<char> find_shared(const TriangleSoup& soup, const SewnSoup& sewn) {
  const std::vector<std::uint32_t> place = weld_points(soup.points).id;
  std::vector<std::uint32_t> user(soup.points.size(), no_index), entity(soup.points.size(), no_index);
  std::vector<char> is_crowded(soup.points.size(), 0), is_shared(soup.points.size(), 0);
  for (std::size_t t = 0; t < sewn.triangles.size(); ++t)
    for (const std::uint32_t v : sewn.triangles[t]) {
      const std::uint32_t p = place[v], e = soup.patch_entity[sewn.triangle_patch[t]];
      if (user[p] == no_index) {
        user[p] = v;
        entity[p] = e;
      }
      if (user[p] != v || entity[p] != e) is_crowded[p] = 1;
    }
  for (std::size_t i = 0; i < is_shared.size(); ++i) is_shared[i] = is_crowded[place[i]];
  return is_shared;
}

}  // namespace

Result<HealedSoup> remove_scars(const TriangleSoup& soup, const ScarMarks& marks, const RemoveScarsOptions& options) {
  if (std::optional<Failure> problem = check(soup, marks)) return *problem;
  const std::vector<std::uint32_t> mates = find_mates(soup.points.size(), soup.triangles, soup.triangle_patch);
  PairedBorders paired = pair_borders(soup, mates, marks.split_edges);
  SewnSoup sewn = suture(soup, mates, std::move(paired.pairs));

  HealedSoup healed;
  ScarReport& report = healed.report;
  report.sewn_edges = sewn.pairs.size();
  report.refused_lips = std::move(paired.refused);
  report.refused_lips.insert(report.refused_lips.end(), sewn.refused.begin(), sewn.refused.end());
  std::sort(report.refused_lips.begin(), report.refused_lips.end(),
            [](const RefusedLip& a, const RefusedLip& b) { return a.half_edge < b.half_edge; });

  std::vector<char> is_scar(soup.points.size(), 0), is_inserted(soup.points.size(), marks.inserted_by_cut.empty());
  std::vector<std::uint32_t> node_of(soup.points.size());  // where a point went, for the ends of original edges
  for (std::uint32_t v = 0; v < soup.points.size(); ++v) node_of[v] = v;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = soup.triangles[t][k], to = sewn.triangles[t][k];
      node_of[from] = to;
      if (marks.inserted_by_cut.empty() || !marks.inserted_by_cut[from]) continue;
      is_inserted[to] = 1;
      if (marks.split_edges.empty()) is_scar[to] = 1;
    }
  for (const LipPair& pair : sewn.pairs)
    for (std::uint32_t end = 0; end < 2; ++end) is_scar[sewn.triangles[pair.first / 3][(pair.first % 3 + end) % 3]] = 1;
  std::vector<std::uint32_t> nodes;
  std::vector<RefusedErasure> kept;
  for (std::uint32_t v = 0; v < soup.points.size(); ++v) {
    if (!is_scar[v]) continue;
    if (is_inserted[v] || !options.keep_original_nodes)
      nodes.push_back(v);
    else
      kept.push_back({v, ErasureRefusal::original_node});
  }
  std::vector<std::array<std::uint32_t, 2>> original_edge = marks.original_edge;
  for (auto& ends : original_edge)
    for (std::uint32_t& v : ends) v = v < node_of.size() ? node_of[v] : no_index;

  const std::vector<char> is_shared = find_shared(soup, sewn);
  report.erasure =
      erase_nodes(soup.points, sewn.triangles, sewn.triangle_patch, nodes, is_shared, original_edge, options.erasure);
  auto& refused = report.erasure.refused;
  refused.insert(refused.end(), kept.begin(), kept.end());
  std::sort(refused.begin(), refused.end(),
            [](const RefusedErasure& a, const RefusedErasure& b) { return a.node < b.node; });

  healed.soup = soup;
  healed.soup.triangles = std::move(sewn.triangles);
  healed.soup.triangle_patch = std::move(sewn.triangle_patch);
  std::vector<char> is_kept(soup.points.size(), 1);  // what nothing used before is not ours to drop
  for (const Triangle& t : soup.triangles)
    for (const std::uint32_t v : t) is_kept[v] = 0;
  healed.source = drop_unused_points(healed.soup, is_kept);
  return healed;
}

}  // namespace strataflow
