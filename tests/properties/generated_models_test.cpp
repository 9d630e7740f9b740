// Every reference model, at several resolutions, turns and orders: a partition of its box, the same one each time.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "base/archive.h"
#include "base/digest.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"
#include "model/box3.h"
#include "properties/rotation.h"
#include "support/shuffled.h"

namespace strataflow {
namespace {

using support::shuffled;

struct GeneratedModel {
  const char* name;
  double resolution_m;
  friend void PrintTo(const GeneratedModel& model, std::ostream* stream) {
    *stream << model.name << ", edges of " << model.resolution_m << " m";
  }
};

TriangleSoup generated(const GeneratedModel& wanted) {
  Result<TriangleSoup> soup = generate_reference_model(wanted.name, {.resolution_m = wanted.resolution_m});
  EXPECT_TRUE(soup) << describe(soup.failure());
  return soup ? *std::move(soup) : TriangleSoup{};
}

StructuralModel built(const TriangleSoup& soup) {
  const Result<BuiltModel> model = build_structural_model(soup);
  EXPECT_TRUE(model) << describe(model.failure());
  if (!model) return {};
  const ValidityReport validity = check_validity(*model);
  EXPECT_TRUE(validity.is_valid()) << validity.violations.front().kind << ": " << validity.violations.front().what;
  EXPECT_EQ(validity.intersecting_triangle_pairs, 0u);
  EXPECT_TRUE(is_sealed(model->model, validity));
  return model->model;
}

using Edge = std::array<std::uint32_t, 2>;
Edge edge_between(std::uint32_t v, std::uint32_t w) { return {std::min(v, w), std::max(v, w)}; }

/// Every facet of a contact is in both its neighbours: each side of each surface is in the frontier of exactly the
/// region the surface names there, and what a region is told to be bounded by closes around its volume.
void expect_facets_shared_by_neighbours(const StructuralModel& model) {
  std::vector<std::array<int, 2>> times_listed(model.surfaces.size(), {0, 0});
  std::vector<std::map<Edge, int>> turns_of_edge(model.regions.size());
  std::vector<double> volume_m3(model.regions.size(), 0.0);
  for (const Frontier& frontier : model.frontiers)
    for (const SurfaceSide& side : frontier.sides) {
      const Surface& surface = model.surfaces[side.surface];
      ++times_listed[side.surface][side.is_positive];
      EXPECT_EQ(side.is_positive ? surface.region_plus : surface.region_minus, frontier.region);
      if (frontier.region == universe) continue;
      const int outward = side.is_positive ? -1 : 1;  // normals on the positive side point into the region
      for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t) {
        const Triangle& v = model.triangles[t];
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t from = v[k], to = v[(k + 1) % 3];
          turns_of_edge[frontier.region][edge_between(from, to)] += from < to ? outward : -outward;
        }
        volume_m3[frontier.region] +=
            outward * dot(model.points[v[0]], cross(model.points[v[1]], model.points[v[2]])) / 6;
      }
    }
  for (const auto& times : times_listed) EXPECT_EQ(times, (std::array<int, 2>{1, 1}));
  for (std::size_t r = 0; r < model.regions.size(); ++r) {
    EXPECT_TRUE(
        std::all_of(turns_of_edge[r].begin(), turns_of_edge[r].end(), [](const auto& e) { return e.second == 0; }))
        << "the boundary of " << model.regions[r].name << " is open";
    EXPECT_NEAR(volume_m3[r] / model.regions[r].volume_m3, 1.0, 1e-9);
  }
}

/// Every edge of a line is an edge of each surface around it, as many times as the line says.
void expect_edges_shared_by_neighbours(const StructuralModel& model) {
  std::vector<std::map<Edge, std::size_t>> triangles_at(model.surfaces.size());
  for (std::size_t t = 0; t < model.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      ++triangles_at[model.triangle_surface[t]][edge_between(model.triangles[t][k], model.triangles[t][(k + 1) % 3])];
  for (const Line& line : model.lines)
    for (std::size_t i = 0; i + (line.is_closed() ? 0 : 1) < line.vertices.size(); ++i) {
      const Edge edge = edge_between(line.vertices[i], line.vertices[(i + 1) % line.vertices.size()]);
      for (const std::uint32_t surface : line.surfaces) {
        const auto borders = static_cast<std::size_t>(std::count(line.surfaces.begin(), line.surfaces.end(), surface));
        ASSERT_TRUE(triangles_at[surface].contains(edge));
        EXPECT_EQ(triangles_at[surface][edge], borders);
      }
    }
}

/// What a model is, whatever the numbers of its parts.
struct Portrait {
  std::size_t corners, lines, surfaces, dangling, points, triangles;
  std::vector<std::pair<std::multiset<std::string>, double>> regions;  ///< entities of the sides, volume; ascending
};

Portrait portrait_of(const StructuralModel& model) {
  Portrait portrait{model.corners.size(),
                    model.lines.size(),
                    model.surfaces.size(),
                    0,
                    model.points.size(),
                    model.triangles.size(),
                    {}};
  for (const Region& region : model.regions) portrait.regions.push_back({{}, region.volume_m3});
  for (const Surface& surface : model.surfaces) {
    portrait.dangling += surface.is_dangling();
    for (const std::uint32_t region : {surface.region_plus, surface.region_minus})
      if (region != universe) portrait.regions[region].first.insert(model.entities[surface.entity].name);
  }
  std::sort(portrait.regions.begin(), portrait.regions.end());
  return portrait;
}

void expect_alike(const Portrait& a, const Portrait& b) {
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.lines, b.lines);
  EXPECT_EQ(a.surfaces, b.surfaces);
  EXPECT_EQ(a.dangling, b.dangling);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
  ASSERT_EQ(a.regions.size(), b.regions.size());
  for (std::size_t r = 0; r < a.regions.size(); ++r) {
    EXPECT_EQ(a.regions[r].first, b.regions[r].first);
    EXPECT_NEAR(a.regions[r].second / b.regions[r].second, 1.0, 1e-9);
  }
}

double total_volume_m3(const StructuralModel& model) {
  return std::accumulate(model.regions.begin(), model.regions.end(), 0.0,
                         [](double sum, const Region& region) { return sum + region.volume_m3; });
}

double extent_m3(const TriangleSoup& soup) {
  Box3 box;
  for (const Vec3& p : soup.points) box.take(p);
  const Vec3 size = box.high - box.low;
  return size.x * size.y * size.z;
}

class GeneratedModels : public testing::TestWithParam<GeneratedModel> {
 protected:
  const TriangleSoup soup_ = generated(GetParam());
  const StructuralModel model_ = built(soup_);
  const double box_m3_ = extent_m3(soup_);
};

TEST_P(GeneratedModels, fill_their_box_and_share_every_facet_and_edge_with_their_neighbours) {
  EXPECT_NEAR(total_volume_m3(model_) / box_m3_, 1.0, 1e-12);
  expect_facets_shared_by_neighbours(model_);
  expect_edges_shared_by_neighbours(model_);
}

TEST_P(GeneratedModels, are_the_same_when_turned_and_shuffled) {
  const Portrait portrait = portrait_of(model_);
  expect_alike(portrait_of(built(shuffled(soup_, 1))), portrait);
  std::uint32_t seed = 2;
  for (const support::Rotation& turn : {support::about_z, support::about_skew_axis}) {
    TriangleSoup turned = shuffled(soup_, seed++);
    for (Vec3& point : turned.points) point = turn(point);
    const StructuralModel model = built(turned);
    expect_alike(portrait_of(model), portrait);
    EXPECT_NEAR(total_volume_m3(model) / box_m3_, 1.0, 1e-9);
    expect_facets_shared_by_neighbours(model);
    expect_edges_shared_by_neighbours(model);
  }
}

TEST_P(GeneratedModels, keep_every_bit_when_only_names_change) {
  TriangleSoup renamed = soup_;
  for (std::size_t e = 0; e < renamed.entities.size(); ++e)
    renamed.entities[e].name = "another " + std::to_string(renamed.entities.size() - e);
  StructuralModel model = built(renamed);
  EXPECT_NE(model.entities.front().name, model_.entities.front().name);
  model.entities = model_.entities;
  const auto digest = [](const StructuralModel& m) {
    ArchiveWriter writer;
    writer(m);
    return digest_of(writer.bytes()).hex();
  };
  EXPECT_EQ(digest(model), digest(model_));
}

TEST_P(GeneratedModels, have_the_same_regions_without_any_patch) {
  TriangleSoup plain = soup_;
  plain.entities = {{"all", Role::unknown}};
  plain.patch_entity = {0};
  std::fill(plain.triangle_patch.begin(), plain.triangle_patch.end(), 0u);
  const StructuralModel model = built(plain);
  std::vector<double> volumes_m3, wanted;
  for (const Region& region : model.regions) volumes_m3.push_back(region.volume_m3);
  for (const Region& region : model_.regions) wanted.push_back(region.volume_m3);
  std::sort(volumes_m3.begin(), volumes_m3.end());
  std::sort(wanted.begin(), wanted.end());
  ASSERT_EQ(volumes_m3.size(), wanted.size());
  for (std::size_t r = 0; r < wanted.size(); ++r) EXPECT_NEAR(volumes_m3[r] / wanted[r], 1.0, 1e-9);
  expect_facets_shared_by_neighbours(model);
  expect_edges_shared_by_neighbours(model);
}

std::vector<GeneratedModel> all_models() {
  std::vector<GeneratedModel> models;
  for (const char* name : {"A1", "A2", "A3", "A4", "A5", "A6", "B", "C"})
    for (const double resolution_m : {200.0, 110.0, 60.0}) models.push_back({name, resolution_m});
  for (const double resolution_m : {15.0, 10.0, 5.0}) models.push_back({"D", resolution_m});
  for (const GeneratedModel& model : {GeneratedModel{"slab", 60},
                                      {"variable-layers", 250},
                                      {"variable-layers", 90},
                                      {"veins", 500},
                                      {"onlap", 10},
                                      {"onlap", 4},
                                      {"sandbox", 430},
                                      {"fault-network", 1500},
                                      {"dfn", 1600}})
    models.push_back(model);
  return models;
}

INSTANTIATE_TEST_SUITE_P(Reference, GeneratedModels, testing::ValuesIn(all_models()), [](const auto& instance) {
  std::string name(instance.param.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name + "_" + std::to_string(static_cast<int>(instance.param.resolution_m)) + "_m";
});

}  // namespace
}  // namespace strataflow
