#include "batch/convert.h"

#include <algorithm>
#include <cctype>

#include "base/atomic_file.h"
#include "io/gocad/write_gocad.h"
#include "io/input/labelled_triangles.h"
#include "io/mesh/write_abaqus.h"
#include "io/mesh/write_gmsh.h"
#include "io/mesh/write_medit.h"
#include "model/soup_of_model.h"
#include "io/model_file/write_model_file.h"
#include "io/surface/write_obj.h"
#include "io/vtk/write_vtk_xml.h"
#include "kernels/topology/building/build_structural_model.h"

namespace strataflow {

namespace {

/// Formats of triangles, the same for a soup and a model.
struct SurfaceFormat {
  std::string_view ending;
  std::string (*write)(const LabelledTriangles&);
};
constexpr SurfaceFormat surface_formats[] = {
    {".vtp", write_vtp}, {".obj", write_obj}, {".mesh", write_medit}, {".msh", write_gmsh}, {".inp", write_abaqus}};

template <std::string (*write)(const VolumeMesh&)>
Result<std::string> nameless(const VolumeMesh& mesh, const std::string&) {
  return write(mesh);
}
struct CellFormat {
  std::string_view ending;
  Result<std::string> (*write)(const VolumeMesh&, const std::string& name);
};
constexpr CellFormat cell_formats[] = {{".vtu", nameless<write_vtu>},
                                       {".mesh", nameless<write_medit>},
                                       {".msh", nameless<write_gmsh>},
                                       {".inp", nameless<write_abaqus>},
                                       {".so", write_gocad_so}};

Failure unknown_ending(std::string_view ending) {
  return {FailureCode::unsupported, "cannot write '" + std::string(ending) + "'", "endings: " + writable_endings()};
}

}  // namespace

std::string writable_endings() {
  std::string text = ".ml, .ts, .sfm";
  for (const SurfaceFormat& format : surface_formats) text += ", " + std::string(format.ending);
  for (const CellFormat& format : cell_formats)
    if (text.find(std::string(format.ending) + ",") == std::string::npos) text += ", " + std::string(format.ending);
  return text;
}

Result<void> can_write(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  if (!ending.empty() && (writable_endings() + ",").find(ending + ",") != std::string::npos) return {};
  return Failure{FailureCode::invalid_usage, "cannot write " + file.string(), "endings: " + writable_endings()};
}

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Result<std::string> encode_model(const StructuralModel& model, std::string_view ending, const std::string& name) {
  if (ending == ".ml") return write_gocad_ml(model, name);
  if (ending == ".ts") return write_gocad_ts(soup_of_model(model));
  for (const SurfaceFormat& format : surface_formats)
    if (ending == format.ending) return format.write(labelled_triangles(model));
  return unknown_ending(ending);
}

Result<std::string> encode_input(const InputData& input, std::string_view ending, const std::string& name) {
  if (input.volume.cell_count() > 0)
    for (const CellFormat& format : cell_formats)
      if (ending == format.ending) return format.write(input.volume, name);
  if (!input.surfaces.triangles.empty()) {
    if (ending == ".ts") return write_gocad_ts(input.surfaces);
    for (const SurfaceFormat& format : surface_formats)
      if (ending == format.ending) return format.write(labelled_triangles(input.surfaces));
    if (ending == ".ml") {
      const Result<BuiltModel> built = build_structural_model(input.surfaces);
      if (!built) return built.failure();
      return write_gocad_ml(built->model, name);
    }
  }
  Failure failure = unknown_ending(ending);
  if (can_write("x" + std::string(ending)))
    failure.what = "the input holds nothing that '" + std::string(ending) + "' can hold (" +
                   std::to_string(input.surfaces.triangles.size()) + " triangles, " +
                   std::to_string(input.volume.cell_count()) + " cells)";
  return failure;
}

std::string left_out(const InputData& input, std::string_view ending) {
  const bool holds_cells = std::any_of(std::begin(cell_formats), std::end(cell_formats),
                                       [&](const CellFormat& format) { return format.ending == ending; });
  const std::size_t cells = input.volume.cell_count();
  std::string text;
  const auto count = [&](std::size_t number, const char* words) {
    if (number > 0) text += (text.empty() ? "" : ", ") + std::to_string(number) + " " + words;
  };
  count(holds_cells ? 0 : cells, "cells");
  count(holds_cells && cells > 0 ? input.surfaces.triangles.size() : 0, "triangles");
  count(input.lines.size(), "lines");
  count(input.point_sets.size(), "point sets");
  return text;
}

Result<void> write_model(const std::filesystem::path& file, const StructuralModel& model) {
  const std::string ending = ending_of(file);
  if (ending == ".sfm") return write_model_file(file, model);
  const Result<std::string> content = encode_model(model, ending, file.stem().string());
  return content ? write_file_atomically(file, *content) : content.failure();
}

Result<void> write_input(const std::filesystem::path& file, const InputData& input, const std::string& name) {
  const std::string ending = ending_of(file);
  if (ending == ".sfm" && !input.surfaces.triangles.empty()) {
    const Result<BuiltModel> built = build_structural_model(input.surfaces);
    return built ? write_model_file(file, built->model) : built.failure();
  }
  const Result<std::string> content = encode_input(input, ending, name);
  return content ? write_file_atomically(file, *content) : content.failure();
}

}  // namespace strataflow
