#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "batch/check_model.h"
#include "io/input/combine_inputs.h"
#include "io/input/local_origin.h"
#include "io/read_input.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"
#include "properties/model_file_texts.h"
#include "support/command_line.h"

namespace strataflow::support {

/// What reading a model has to find.
struct ModelFacts {
  std::size_t regions = 0, surfaces = 0, lines = 0, corners = 0;
  std::vector<double> volumes_m3;  ///< ascending
};

inline std::filesystem::path shared_data() {
  const char* folder = std::getenv("STRATAFLOW_DATA");
  return folder ? std::filesystem::path(folder) : std::filesystem::path(STRATAFLOW_SOURCE_DIR) / "../shared/data";
}

/// Facts about a file of the shared data: with the names and groups it holds, or by geometry alone.
inline ModelFacts expected_facts(const std::string& file, bool with_names) {
  if (file == "ringmesh-tiny/non_split_cube.ml")  // a horizon that starts on three walls of a unit cube and ends inside
    return {1, 2, 2, 2, {1.0}};
  const nlohmann::json all = nlohmann::json::parse(read_text(shared_data() / "expected.json"));
  const nlohmann::json& model = all.at(file);
  ModelFacts facts;
  if (model.contains("region_volumes")) {
    facts.volumes_m3 = model["region_volumes"].get<std::vector<double>>();
  } else {  // told as shells: the outer one is negative
    for (const auto& shell : model.at("shells"))
      if (const double volume = shell.at("signed_volume").get<double>(); volume > 0) facts.volumes_m3.push_back(volume);
  }
  std::sort(facts.volumes_m3.begin(), facts.volumes_m3.end());
  facts.regions = facts.volumes_m3.size();
  const nlohmann::json& counts = with_names ? model : model.value("without_names", model);
  facts.surfaces = counts.at("surfaces").get<std::size_t>();
  facts.lines = counts.at("lines").get<std::size_t>();
  facts.corners = counts.at("corners").get<std::size_t>();
  return facts;
}

inline InputData read_texts(const std::vector<TextFile>& files) {
  std::vector<InputData> parts;
  for (const TextFile& file : files) {
    Result<InputData> part = read_input_bytes(file.text, file.name);
    EXPECT_TRUE(part) << describe(part.failure());
    if (part) parts.push_back(*std::move(part));
  }
  InputData whole = *combine_inputs(std::move(parts));
  shift_to_local_origin(whole);
  return whole;
}

inline CheckedModel checked(const TriangleSoup& soup) {
  CheckedModel model;
  Result<BuiltModel> built = build_structural_model(soup);
  EXPECT_TRUE(built) << describe(built.failure());
  if (built) model.built = *std::move(built);
  model.validity = check_validity(model.built);
  return model;
}

inline CheckedModel checked(const std::vector<TextFile>& files) { return checked(read_texts(files).surfaces); }

inline std::set<std::string> errors_of(const CheckedModel& model) {
  std::set<std::string> kinds;
  for (const Violation& violation : model.validity.violations)
    if (violation.severity == Violation::Severity::error) kinds.insert(violation.kind);
  return kinds;
}

inline std::map<std::string, double> volume_of_name(const StructuralModel& model) {
  std::map<std::string, double> volumes;
  for (const Region& region : model.regions) volumes[region.name] = region.volume_m3;
  return volumes;
}

constexpr double volume_tolerance_ratio = 1e-9;

inline void expect_volumes(std::vector<double> volumes_m3, const ModelFacts& facts) {
  std::sort(volumes_m3.begin(), volumes_m3.end());
  ASSERT_EQ(volumes_m3.size(), facts.regions);
  for (std::size_t r = 0; r < volumes_m3.size(); ++r)
    EXPECT_NEAR(volumes_m3[r] / facts.volumes_m3[r], 1.0, volume_tolerance_ratio);
}

/// The counts and volumes, whatever the model's validity.
inline void expect_counts(const StructuralModel& model, const ModelFacts& facts) {
  EXPECT_EQ(model.surfaces.size(), facts.surfaces);
  EXPECT_EQ(model.lines.size(), facts.lines);
  EXPECT_EQ(model.corners.size(), facts.corners);
  std::vector<double> volumes_m3;
  for (const Region& region : model.regions) volumes_m3.push_back(region.volume_m3);
  expect_volumes(volumes_m3, facts);
}

/// The counts and volumes of a sealed model that breaks no rule.
inline void expect_facts(const CheckedModel& model, const ModelFacts& facts) {
  expect_counts(model.built.model, facts);
  EXPECT_EQ(model.validity.intersecting_triangle_pairs, 0u);
  EXPECT_EQ(errors_of(model), std::set<std::string>{});
  EXPECT_TRUE(is_sealed(model.built.model, model.validity));
}

}  // namespace strataflow::support
