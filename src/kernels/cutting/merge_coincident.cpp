#include "kernels/cutting/merge_coincident.h"

#include <algorithm>
#include <map>
#include <string>

#include "kernels/cutting/suspected_repeats.h"
#include "kernels/topology/sorted_unique.h"

namespace strataflow {

namespace {

/// Runs of identical triangles, each ascending, in the order of their vertices.
std::vector<std::vector<std::uint32_t>> find_identical(const CutMesh& mesh) {
  struct Sorted {
    Triangle vertices;
    std::uint32_t triangle;
    auto operator<=>(const Sorted&) const = default;
  };
  std::vector<Sorted> sorted;
  for (const std::uint32_t t : suspected_repeats(mesh.points.size(), mesh.triangles)) {
    sorted.push_back({mesh.triangles[t], t});
    std::sort(sorted.back().vertices.begin(), sorted.back().vertices.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::vector<std::uint32_t>> runs;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    while (end < sorted.size() && sorted[end].vertices == sorted[begin].vertices) ++end;
    if (end - begin < 2) continue;
    runs.emplace_back();
    for (std::size_t i = begin; i < end; ++i) runs.back().push_back(sorted[i].triangle);
  }
  return runs;
}

}  // namespace

std::vector<std::uint32_t> merge_coincident(CutMesh& mesh, const TriangleSoup& input, TriangleSoup& out,
                                            std::vector<Change>& changes) {
  out.patch_entity = input.patch_entity;
  out.patch_other_entities = input.patch_other_entities;
  std::vector<std::uint32_t> patch;
  patch.reserve(mesh.origin.size());
  for (const std::uint32_t origin : mesh.origin) patch.push_back(input.triangle_patch[origin]);
  auto runs = find_identical(mesh);
  if (runs.empty()) return patch;

  std::map<std::vector<std::uint32_t>, std::uint32_t> patch_of_set;
  std::map<std::vector<std::uint32_t>, std::uint64_t> triangles_of_entities;
  std::vector<char> is_kept(mesh.triangles.size(), 1);
  for (std::vector<std::uint32_t>& run : runs) {
    std::vector<std::uint32_t> patches, entities, owners;
    for (const std::uint32_t t : run) owners.push_back(input.patch_entity[patch[t]]);
    // The youngest entity's own triangle stands for all, turned as it is there.
    const auto youngest = std::find(owners.begin(), owners.end(), youngest_of(input.entities, owners));
    std::swap(run[0], run[static_cast<std::size_t>(youngest - owners.begin())]);
    for (const std::uint32_t t : run) {
      is_kept[t] = t == run[0];
      patches.push_back(patch[t]);
      const std::vector<std::uint32_t> own = input.entities_of(patch[t]);
      entities.insert(entities.end(), own.begin(), own.end());
    }
    entities = sorted_unique(std::move(entities));
    if (entities.size() == input.entities_of(patch[run[0]]).size()) continue;  // the first stands for all as it is
    ++triangles_of_entities[entities];
    const auto [place, is_new] = patch_of_set.try_emplace(sorted_unique(std::move(patches)),
                                                          static_cast<std::uint32_t>(out.patch_entity.size()));
    patch[run[0]] = place->second;
    if (!is_new) continue;
    out.patch_entity.push_back(youngest_of(input.entities, entities));
    std::erase(entities, out.patch_entity.back());
    out.patch_other_entities.resize(out.patch_entity.size());
    out.patch_other_entities.back() = std::move(entities);
  }
  for (const auto& [entities, count] : triangles_of_entities) {
    std::string names;
    for (const std::uint32_t e : entities)
      names += (names.empty() ? "'" : e == entities.back() ? " and '" : ", '") + input.entities[e].name + "'";
    changes.push_back({"coincident_patches", names + " share " + std::to_string(count) + " triangles",
                       "they are identical there, and one surface stands for all of them"});
  }
  std::size_t next = 0;
  for (std::size_t t = 0; t < patch.size(); ++t)
    if (is_kept[t]) patch[next++] = patch[t];
  patch.resize(next);
  mesh.keep(is_kept);
  return patch;
}

}  // namespace strataflow
