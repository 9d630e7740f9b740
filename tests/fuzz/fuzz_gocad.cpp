#include <cstddef>
#include <cstdint>
#include <string_view>

#include "io/gocad/read_gocad.h"
#include "io/gocad/write_gocad.h"
#include "io/input/combine_inputs.h"
#include "io/input/local_origin.h"

/// Whatever the bytes: a value or a named failure; and what was read can be combined, shifted and written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strataflow;
  Result<InputData> input = read_gocad(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.ml");
  if (!input) {
    STRATAFLOW_ASSERT(!input.failure().what.empty() && !input.failure().remedy.empty(), "a failure without words");
    return 0;
  }
  const std::size_t point_count = input->surfaces.points.size();
  for (const Triangle& triangle : input->surfaces.triangles)
    for (const std::uint32_t vertex : triangle) STRATAFLOW_ASSERT(vertex < point_count, "vertex out of range");
  for (const std::uint32_t vertex : input->volume.cell_vertices)
    STRATAFLOW_ASSERT(vertex < input->volume.points.size(), "cell vertex out of range");
  for (const std::uint32_t patch : input->surfaces.triangle_patch)
    STRATAFLOW_ASSERT(patch < input->surfaces.patch_entity.size(), "patch out of range");
  for (const RegionRecord& region : input->surfaces.regions)
    for (const PatchSide& side : region.sides)
      STRATAFLOW_ASSERT(side.patch < input->surfaces.patch_entity.size(), "region side out of range");
  for (const PointProperty& property : input->surfaces.properties)
    STRATAFLOW_ASSERT(property.values.size() == point_count * property.width, "property of another length");
  InputData both = *combine_inputs({*input, *input});
  shift_to_local_origin(both);
  const std::string text = write_gocad_ts(both.surfaces);
  if (!both.surfaces.triangles.empty()) {
    const Result<InputData> again = read_gocad(text, "again.ts");
    STRATAFLOW_ASSERT(again, "what was written does not read: " + again.failure().what);
    STRATAFLOW_ASSERT(again->surfaces.triangles.size() == both.surfaces.triangles.size(), "triangles were lost");
  }
  return 0;
}
