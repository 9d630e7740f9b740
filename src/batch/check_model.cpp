#include "batch/check_model.h"

#include <cmath>

#include "batch/report/html_page.h"
#include "graph/parallel/parallel_map.h"
#include "io/input/combine_inputs.h"
#include "io/input/local_origin.h"
#include "io/read_input.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"

namespace strataflow {

Result<InputData> read_inputs(const std::vector<std::filesystem::path>& files) {
  auto parts = parallel_map(files.size(), [&](std::size_t i) { return std::optional(read_input(files[i])); });
  std::vector<InputData> data;
  for (auto& part : parts) {
    if (!*part) return part->failure();
    data.push_back(std::move(**part));
  }
  Result<InputData> whole = combine_inputs(std::move(data));
  if (whole) shift_to_local_origin(*whole);
  return whole;
}

Result<CheckedModel> check_model(const std::vector<std::filesystem::path>& files) {
  Result<InputData> input = read_inputs(files);
  if (!input) return input.failure();
  Result<BuiltModel> built = build_structural_model(input->surfaces);
  if (!built) {
    Failure failure = built.failure();
    std::string names;
    for (const std::filesystem::path& file : files) names += (names.empty() ? "" : ", ") + file.filename().string();
    failure.what = names + ": " + failure.what;
    if (input->volume.cell_count() > 0) failure.remedy = "to judge a volume mesh, run `strataflow quality` on it";
    return failure;
  }
  CheckedModel checked{*std::move(built), {}, std::move(input->warnings)};
  checked.validity = check_validity(checked.built);
  return checked;
}

std::string model_text(const CheckedModel& checked) {
  const StructuralModel& model = checked.built.model;
  const auto count = [](std::size_t number, const char* word) {
    return std::to_string(number) + " " + word + (number == 1 ? "" : "s");
  };
  std::string text = count(model.regions.size(), "region") + ", " + count(model.surfaces.size(), "surface") + ", " +
                     count(model.lines.size(), "line") + ", " + count(model.corners.size(), "corner") + ", " +
                     count(model.triangles.size(), "triangle") + ", " + std::to_string(model.points.size()) +
                     " vertices, " + (is_sealed(model, checked.validity) ? "sealed" : "not sealed") + "\n";
  std::vector<std::size_t> surfaces(model.entities.size(), 0);
  for (const Surface& surface : model.surfaces)
    for (const std::uint32_t entity : surface.all_entities) ++surfaces[entity];
  for (std::size_t i = 0; i < model.entities.size(); ++i)
    text += "  " + std::string(to_string(model.entities[i].role)) + " " + model.entities[i].name + ": " +
            count(surfaces[i], "surface") + "\n";
  for (std::size_t i = 0; i < model.regions.size(); ++i)
    text += "  region " + std::to_string(i) + " " + model.regions[i].name + ": " +
            readable_number(model.regions[i].volume_m3) + (std::isnan(model.regions[i].volume_m3) ? " volume\n" : " m3\n");
  for (const Violation& violation : checked.validity.violations)
    text += std::string(violation.severity == Violation::Severity::error ? "error" : "warning") + ": " +
            violation.kind + ": " + violation.what + "\n  what to do: " + violation.remedy + "\n";
  text += checked.validity.is_valid() ? "valid\n" : "not valid\n";
  return text;
}

}  // namespace strataflow
