// Raw fault models and fracture networks, cut: nothing crosses any more, every name is still there.
#include "kernels/cutting/cut_surfaces.h"

#include <limits>

#include "kernels/quality/check_mesh_against_model.h"
#include "kernels/volumes/tetrahedralize_model.h"
#include "properties/entity_names.h"
#include "properties/read_model.h"

namespace strataflow {
namespace {

struct RawSurfaces {
  const char* name;
  const char* path;  ///< a file, or a folder of files
  std::size_t entities;
  std::uint64_t crossing_pairs;  ///< improper ones, between entities and within them, as counted by CGAL's predicates
};

/// Faults and fractures that stand free in space.
InputData read_raw(const RawSurfaces& raw) {
  const std::filesystem::path path = support::shared_data() / raw.path;
  std::vector<std::filesystem::path> files = {path};
  if (std::filesystem::is_directory(path)) {
    files.clear();
    for (const auto& entry : std::filesystem::directory_iterator(path)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
  }
  Result<InputData> input = read_inputs(files);
  EXPECT_TRUE(input) << describe(input.failure());
  return input ? *std::move(input) : InputData{};
}

class RealSurfaces : public testing::TestWithParam<RawSurfaces> {
 protected:
  void SetUp() override {
    const std::filesystem::path path = support::shared_data() / GetParam().path;
    if (!std::filesystem::exists(path))
      GTEST_SKIP() << path << " is not there: set STRATAFLOW_DATA to the folder of the real models";
    surfaces_ = read_raw(GetParam()).surfaces;
    ASSERT_EQ(support::names_of(surfaces_.entities).size(), GetParam().entities);
  }
  TriangleSoup surfaces_;
};

TEST_P(RealSurfaces, conform_and_keep_their_names_when_cut) {
  const Result<CutResult> cut = cut_surfaces(surfaces_);
  ASSERT_TRUE(cut) << describe(cut.failure());
  EXPECT_EQ(cut->report.intersecting_pairs, GetParam().crossing_pairs);
  EXPECT_EQ(cut->report.pairs_left, 0u);
  const CheckedModel checked = support::checked(cut->soup);
  EXPECT_EQ(checked.validity.intersecting_triangle_pairs, 0u);
  EXPECT_FALSE(support::errors_of(checked).contains("non_conforming_contact"));
  EXPECT_EQ(support::names_on_surfaces(checked.built.model), support::names_of(surfaces_.entities));
}

constexpr RawSurfaces fracture_networks[] = {{"dfn1", "dfn/dfn1_ascii.vtp", 1, 232},
                                             {"dfn2", "dfn/dfn2_mesh_compressed.vtp", 1, 1045},
                                             {"lagrit", "dfn/lagrit_tri_dfn.inp", 1, 0}};
constexpr RawSurfaces faults[] = {{"cfm_etra", "scec-cfm61/native_ETRA", 17, 199 + 9},
                                  {"cfm_native", "scec-cfm61/cfm61_native.tar.gz", 443, 21978 + 1414}};
constexpr auto name_of = [](const auto& instance) { return std::string(instance.param.name); };
INSTANTIATE_TEST_SUITE_P(Faults, RealSurfaces, testing::ValuesIn(faults), name_of);
INSTANTIATE_TEST_SUITE_P(Fractures, RealSurfaces, testing::ValuesIn(fracture_networks), name_of);

/// Twelve triangles around everything.
double add_box_around(TriangleSoup& soup) {
  Box3 box;
  for (const Vec3& point : soup.points) box.take(point);
  const Vec3 margin = 0.1 * box.diagonal_m() * Vec3{1, 1, 1};
  const Vec3 low = box.low - margin, high = box.high + margin;
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (int corner = 0; corner < 8; ++corner)
    soup.points.push_back({corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
  for (PointProperty& property : soup.properties)
    property.values.resize(soup.points.size() * property.width, std::numeric_limits<double>::quiet_NaN());
  const auto patch = static_cast<std::uint32_t>(soup.patch_entity.size());
  soup.patch_entity.push_back(static_cast<std::uint32_t>(soup.entities.size()));
  soup.entities.push_back({"box", Role::boundary});
  constexpr std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads)
    for (const Triangle& t : {Triangle{q[0], q[1], q[2]}, Triangle{q[0], q[2], q[3]}}) {
      soup.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      soup.triangle_patch.push_back(patch);
    }
  return (high.x - low.x) * (high.y - low.y) * (high.z - low.z);
}

class FractureNetwork : public RealSurfaces {};

TEST_P(FractureNetwork, is_filled_with_conforming_tetrahedra_in_a_box) {
  const double volume_m3 = add_box_around(surfaces_);
  const Result<CutResult> cut = cut_surfaces(surfaces_);
  ASSERT_TRUE(cut) << describe(cut.failure());
  const CheckedModel checked = support::checked(cut->soup);
  ASSERT_TRUE(is_sealed(checked.built.model, checked.validity));
  const Result<VolumeMesh> mesh = tetrahedralize_model(checked.built.model);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  EXPECT_TRUE(check_mesh_against_model(*mesh, checked.built.model).empty());
  double model_m3 = 0;
  for (const Region& region : checked.built.model.regions) model_m3 += region.volume_m3;
  EXPECT_NEAR(model_m3 / volume_m3, 1, 1e-9);
}
INSTANTIATE_TEST_SUITE_P(Real, FractureNetwork, testing::ValuesIn(fracture_networks), name_of);

}  // namespace
}  // namespace strataflow
