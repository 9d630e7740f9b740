#include "batch/convert.h"

#include <algorithm>
#include <cctype>

#include "io/labelled_triangles.h"
#include "io/write_abaqus.h"
#include "io/write_gmsh.h"
#include "io/write_gocad.h"
#include "io/write_medit.h"
#include "io/write_obj.h"
#include "io/write_vtk_xml.h"
#include "kernels/topology/build_structural_model.h"

namespace strataflow {

namespace {

TriangleSoup soup_of(const StructuralModel& model) {
  TriangleSoup soup;
  soup.local_origin = model.local_origin;
  soup.points = model.points;
  soup.triangles = model.triangles;
  soup.triangle_patch = model.triangle_surface;
  for (const Surface& surface : model.surfaces) soup.patch_entity.push_back(surface.entity);
  soup.entities = model.entities;
  soup.properties = model.properties;
  return soup;
}

/// Formats of triangles, the same for a soup and a model.
struct SurfaceFormat {
  std::string_view ending;
  std::string (*write)(const LabelledTriangles&);
};
constexpr SurfaceFormat surface_formats[] = {
    {".vtp", write_vtp}, {".obj", write_obj}, {".mesh", write_medit}, {".msh", write_gmsh}, {".inp", write_abaqus}};

struct CellFormat {
  std::string_view ending;
  std::string (*write)(const VolumeMesh&);
};
constexpr CellFormat cell_formats[] = {
    {".vtu", write_vtu}, {".mesh", write_medit}, {".msh", write_gmsh}, {".inp", write_abaqus}};

Failure unknown_ending(std::string_view ending) {
  return {FailureCode::unsupported, "cannot write '" + std::string(ending) + "'", "endings: " + writable_endings()};
}

}  // namespace

std::string writable_endings() {
  std::string text = ".ml, .ts";
  for (const SurfaceFormat& format : surface_formats) text += ", " + std::string(format.ending);
  for (const CellFormat& format : cell_formats)
    if (text.find(std::string(format.ending) + ",") == std::string::npos) text += ", " + std::string(format.ending);
  return text;
}

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Result<std::string> encode_model(const StructuralModel& model, std::string_view ending, const std::string& name) {
  if (ending == ".ml") return write_gocad_ml(model, name);
  if (ending == ".ts") return write_gocad_ts(soup_of(model));
  for (const SurfaceFormat& format : surface_formats)
    if (ending == format.ending) return format.write(labelled_triangles(model));
  return unknown_ending(ending);
}

Result<std::string> encode_input(const InputData& input, std::string_view ending, const std::string& name) {
  if (input.volume.cell_count() > 0)
    for (const CellFormat& format : cell_formats)
      if (ending == format.ending) return format.write(input.volume);
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
  if (writable_endings().find(ending) != std::string::npos && !ending.empty())
    failure.what = "the input holds nothing that '" + std::string(ending) + "' can hold (" +
                   std::to_string(input.surfaces.triangles.size()) + " triangles, " +
                   std::to_string(input.volume.cell_count()) + " cells)";
  return failure;
}

}  // namespace strataflow
