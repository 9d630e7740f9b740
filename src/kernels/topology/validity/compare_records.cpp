#include "kernels/topology/validity/compare_records.h"

#include <algorithm>
#include <array>
#include <string>

#include "base/id.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

bool is_universe_record(const RegionRecord& record) { return record.name == "Universe"; }

/// Per border record: its two points are the ends of an edge of a triangle, copies of a point being told apart. Along
/// the slit that a fault leaves in a horizon, a record can name one copy from each lip, which is no edge.
std::vector<char> find_own_edges(const TriangleSoup& soup) {
  struct Start {
    std::array<std::uint32_t, 2> ends;
    std::uint32_t record;
    auto operator<=>(const Start&) const = default;
  };
  std::vector<Start> starts;
  std::vector<char> is_end(soup.points.size(), 0);
  for (std::uint32_t b = 0; b < soup.border_starts.size(); ++b) {
    const auto [v, w] = soup.border_starts[b];
    starts.push_back({{std::min(v, w), std::max(v, w)}, b});
    is_end[v] = is_end[w] = 1;
  }
  std::sort(starts.begin(), starts.end());
  std::vector<char> found(starts.size(), 0);
  for (const Triangle& t : soup.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = t[k], w = t[(k + 1) % 3];
      if (!is_end[v] || !is_end[w]) continue;
      const std::array<std::uint32_t, 2> ends{std::min(v, w), std::max(v, w)};
      for (auto s = std::lower_bound(starts.begin(), starts.end(), Start{ends, 0});
           s != starts.end() && s->ends == ends; ++s)
        found[s->record] = 1;
    }
  return found;
}

struct Match {
  double likeness;  ///< shared patches over all patches of both
  std::uint32_t record, region;
};

}  // namespace

void name_regions(StructuralModel& model, const TriangleSoup& soup,
                  const std::vector<std::vector<std::uint32_t>>& patches_of_surface) {
  std::vector<std::vector<std::uint32_t>> patches_of_region(model.regions.size());
  for (std::size_t s = 0; s < model.surfaces.size(); ++s)
    for (const std::uint32_t region : {model.surfaces[s].region_plus, model.surfaces[s].region_minus})
      if (region != universe)
        patches_of_region[region].insert(patches_of_region[region].end(), patches_of_surface[s].begin(),
                                         patches_of_surface[s].end());
  for (auto& patches : patches_of_region) patches = sorted_unique(std::move(patches));

  std::vector<Match> matches;
  for (std::uint32_t record = 0; record < soup.regions.size(); ++record) {
    if (is_universe_record(soup.regions[record])) continue;
    std::vector<std::uint32_t> named;
    for (const PatchSide& side : soup.regions[record].sides) named.push_back(side.patch);
    named = sorted_unique(std::move(named));
    for (std::uint32_t region = 0; region < model.regions.size(); ++region) {
      std::vector<std::uint32_t> shared;
      std::set_intersection(named.begin(), named.end(), patches_of_region[region].begin(),
                            patches_of_region[region].end(), std::back_inserter(shared));
      if (shared.empty()) continue;
      const auto all = static_cast<double>(named.size() + patches_of_region[region].size() - shared.size());
      matches.push_back({static_cast<double>(shared.size()) / all, record, region});
    }
  }
  std::sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) {
    if (a.likeness != b.likeness) return a.likeness > b.likeness;
    return a.record != b.record ? a.record < b.record : a.region < b.region;
  });
  std::vector<std::uint32_t> region_of_record(soup.regions.size(), no_index);
  for (const Match& match : matches) {
    if (region_of_record[match.record] != no_index || !model.regions[match.region].name.empty()) continue;
    region_of_record[match.record] = match.region;
    model.regions[match.region].name = soup.regions[match.record].name;
  }
  for (std::size_t r = 0; r < model.regions.size(); ++r)
    if (model.regions[r].name.empty()) model.regions[r].name = "region_" + std::to_string(r + 1);
  for (const LayerRecord& record : soup.layers) {
    Layer layer{record.name, {}};
    for (const std::uint32_t r : record.regions)
      if (r < region_of_record.size() && region_of_record[r] != no_index) layer.regions.push_back(region_of_record[r]);
    layer.regions = sorted_unique(std::move(layer.regions));
    model.layers.push_back(std::move(layer));
  }
}

std::vector<Violation> compare_borders(const StructuralModel& model, const EdgeTable& edges, const TriangleSoup& soup,
                                       const std::vector<std::uint32_t>& id_of_point) {
  std::vector<Violation> violations;
  const auto point_text = [&](std::uint32_t soup_point) {
    const Vec3 p = soup.points[soup_point] + soup.local_origin;
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
  };
  std::uint64_t lost_stones = 0, superfluous = 0, lost_borders = 0;
  std::uint32_t lost_stone = 0, superfluous_stone = 0, lost_border = 0;
  for (const std::uint32_t stone : soup.border_stones) {
    const std::uint32_t v = id_of_point[stone];
    if (v != no_index && model.point_corner[v] >= 0) continue;
    if (v == no_index || model.point_line[v] < 0) {
      if (lost_stones++ == 0) lost_stone = stone;
    } else if (!model.lines[static_cast<std::size_t>(model.point_line[v])].is_closed()) {  // a loop needs one stone
      if (superfluous++ == 0) superfluous_stone = stone;
    }
  }
  const std::vector<char> is_own_edge = find_own_edges(soup);
  for (std::uint32_t b = 0; b < soup.border_starts.size(); ++b) {
    const std::uint32_t v = id_of_point[soup.border_starts[b][0]], w = id_of_point[soup.border_starts[b][1]];
    const std::uint32_t e = v == no_index || w == no_index ? no_index : find_edge(edges, v, w);
    const bool on_line = e != no_index && is_own_edge[b] && is_feature_edge(edges, e, model.triangle_surface);
    if (!on_line && lost_borders++ == 0) lost_border = b;
  }
  const char* rebuild = "`strataflow check --repair` and `run` rebuild borders from the geometry";
  if (lost_stones > 0)
    violations.push_back(
        {"inconsistent_border", Violation::Severity::error,
         std::to_string(lost_stones) + " border stones (BSTONE) lie on no line, the first at " + point_text(lost_stone),
         rebuild, soup.points[lost_stone], lost_stones, true});
  if (lost_borders > 0)
    violations.push_back(
        {"inconsistent_border", Violation::Severity::error,
         std::to_string(lost_borders) +
             " borders (BORDER) do not start along an edge of their surface that lies on a line, the first at " +
             point_text(soup.border_starts[lost_border][0]),
         rebuild, soup.points[soup.border_starts[lost_border][0]], lost_borders, true});
  if (superfluous > 0)
    violations.push_back({"superfluous_border_stone", Violation::Severity::warning,
                          std::to_string(superfluous) +
                              " border stones lie inside a line where no surface ends, the first at " +
                              point_text(superfluous_stone),
                          "nothing: the minimal lines are used", soup.points[superfluous_stone], superfluous});
  return violations;
}

std::vector<Violation> compare_region_records(const StructuralModel& model, const TriangleSoup& soup,
                                              const std::vector<std::vector<std::uint32_t>>& patches_of_surface) {
  std::vector<std::vector<std::uint32_t>> records_of_patch(soup.patch_entity.size());
  for (std::uint32_t record = 0; record < soup.regions.size(); ++record)
    for (const PatchSide& side : soup.regions[record].sides)
      if (records_of_patch[side.patch].empty() || records_of_patch[side.patch].back() != record)
        records_of_patch[side.patch].push_back(record);
  std::vector<Violation> violations;
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
    const Surface& surface = model.surfaces[s];
    if (!surface.is_dangling()) continue;
    std::vector<std::uint32_t> records;
    for (const std::uint32_t patch : patches_of_surface[s])
      records.insert(records.end(), records_of_patch[patch].begin(), records_of_patch[patch].end());
    records = sorted_unique(std::move(records));
    if (records.size() < 2) continue;
    violations.push_back({"leak", Violation::Severity::error,
                          "surface " + std::to_string(s) + " of '" + model.entities[surface.entity].name +
                              "' should part '" + soup.regions[records[0]].name + "' from '" +
                              soup.regions[records[1]].name + "', but the space on its two sides is one",
                          "close the gap along its border", model.points[model.triangles[surface.first_triangle][0]],
                          1});
  }
  return violations;
}

}  // namespace strataflow
