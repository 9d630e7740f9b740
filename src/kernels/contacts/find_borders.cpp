#include "kernels/contacts/find_borders.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "base/id.h"
#include "kernels/topology/building/edge_table.h"
#include "kernels/topology/building/weld_points.h"

namespace strataflow {

namespace {

/// A border edge seen from one of its ends.
struct Spoke {
  std::uint32_t entity, from, to, triangle;
  friend auto operator<=>(const Spoke&, const Spoke&) = default;
};

}  // namespace

std::vector<Border> find_borders(const TriangleSoup& soup, const BorderOptions& options) {
  const WeldedPoints welded = weld_points(soup.points);
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> source;
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    const Triangle& t = soup.triangles[i];
    const Triangle tri{welded.id[t[0]], welded.id[t[1]], welded.id[t[2]]};
    if (tri[0] == tri[1] || tri[1] == tri[2] || tri[2] == tri[0]) continue;
    triangles.push_back(tri);
    source.push_back(static_cast<std::uint32_t>(i));
  }
  const EdgeTable table = build_edge_table(welded.source.size(), triangles);
  std::vector<Spoke> spokes;
  for (std::uint32_t edge = 0; edge < table.edge_count(); ++edge) {
    const auto entity_of = [&](std::uint32_t half_edge) {
      return soup.patch_entity[soup.triangle_patch[source[half_edge / 3]]];
    };
    for (const std::uint32_t h : table.around(edge)) {
      const auto same = [&](std::uint32_t other) { return entity_of(other) == entity_of(h); };
      if (std::count_if(table.around(edge).begin(), table.around(edge).end(), same) != 1) continue;
      const auto [a, b] = table.edges[edge];
      spokes.push_back({entity_of(h), a, b, source[h / 3]});
      spokes.push_back({entity_of(h), b, a, source[h / 3]});
    }
  }
  std::sort(spokes.begin(), spokes.end());

  const auto range_at = [&](std::uint32_t entity, std::uint32_t vertex) {
    const auto less = [](const Spoke& s, const Spoke& key) {
      return std::tie(s.entity, s.from) < std::tie(key.entity, key.from);
    };
    const auto [first, last] = std::equal_range(spokes.begin(), spokes.end(), Spoke{entity, vertex, 0, 0}, less);
    return std::pair<std::size_t, std::size_t>(first - spokes.begin(), last - spokes.begin());
  };
  const auto at = [&](std::uint32_t vertex) -> const Vec3& { return soup.points[welded.source[vertex]]; };
  const double stone_cosine = std::cos(options.stone_angle_deg * std::numbers::pi / 180);
  std::vector<char> is_stone(spokes.size(), 0), is_used(spokes.size(), 0);
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    const auto [first, last] = range_at(spokes[i].entity, spokes[i].from);
    if (last - first != 2) {
      is_stone[i] = 1;
      continue;
    }
    const Vec3 in = at(spokes[i].from) - at(spokes[first].to), out = at(spokes[first + 1].to) - at(spokes[i].from);
    is_stone[i] = dot(in, out) < stone_cosine * length(in) * length(out);
  }

  std::vector<Border> borders;
  const auto trace = [&](std::size_t start) {
    Border border{spokes[start].entity, {welded.source[spokes[start].from]}, {}, false};
    const std::uint32_t origin = spokes[start].from;
    for (std::size_t i = start;;) {
      is_used[i] = 1;
      border.triangles.push_back(spokes[i].triangle);
      const std::uint32_t from = spokes[i].from, to = spokes[i].to;
      const auto [first, last] = range_at(border.entity, to);
      std::size_t back = first;
      while (spokes[back].to != from) ++back;
      is_used[back] = 1;
      if (!is_stone[start] && to == origin) {
        border.is_closed = true;
        break;
      }
      border.points.push_back(welded.source[to]);
      if (is_stone[back]) break;
      i = back == first ? first + 1 : first;
    }
    borders.push_back(std::move(border));
  };
  for (const char with_stones : {char{1}, char{0}})
    for (std::size_t i = 0; i < spokes.size(); ++i)
      if (!is_used[i] && is_stone[i] == with_stones) trace(i);
  std::stable_sort(borders.begin(), borders.end(), [](const Border& a, const Border& b) {
    return std::tie(a.entity, a.points[0]) < std::tie(b.entity, b.points[0]);
  });
  return borders;
}

}  // namespace strataflow
