#include "io/read_input.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

#include "io/bytes/input_file.h"
#include "io/bytes/tar_members.h"
#include "io/gocad/read_gocad.h"
#include "io/input/combine_inputs.h"
#include "io/lines/read_fault_map.h"
#include "io/lines/read_geo.h"
#include "io/lines/read_pol.h"
#include "io/mesh/read_gmsh.h"
#include "io/mesh/read_medit.h"
#include "io/mesh/read_ucd.h"
#include "io/model_file/read_model_file.h"
#include "io/simulator/read_grdecl.h"
#include "io/simulator/read_roff.h"
#include "io/surface/read_irap.h"
#include "io/surface/read_obj.h"
#include "io/surface/read_off.h"
#include "io/surface/read_ply.h"
#include "io/surface/read_stl.h"
#include "io/vtk/read_vtk_legacy.h"
#include "io/vtk/read_vtk_xml.h"
#include "model/soup_of_model.h"

namespace strataflow {

namespace {

// One row per ending; a reader has the signature Result<InputData> read_<format>(bytes, file_name).
constexpr std::array formats{
    InputFormat{"ml", "GOCAD Model3d", read_gocad},
    InputFormat{"ts", "GOCAD TSurf", read_gocad},
    InputFormat{"pl", "GOCAD PLine", read_gocad},
    InputFormat{"vs", "GOCAD VSet", read_gocad},
    InputFormat{"wl", "GOCAD Well", read_gocad},
    InputFormat{"so", "GOCAD TSolid", read_gocad},
    InputFormat{"lso", "GOCAD LightTSolid", read_gocad},
    InputFormat{"gocad", "GOCAD objects", read_gocad},
    InputFormat{"obj", "Wavefront OBJ", read_obj},
    InputFormat{"off", "Object File Format", read_off},
    InputFormat{"ply", "Stanford PLY, ascii or binary", read_ply},
    InputFormat{"stl", "STL, ascii or binary", read_stl},
    InputFormat{"vtk", "legacy VTK", read_vtk_legacy},
    InputFormat{"vtp", "VTK XML surfaces", read_vtk_xml},
    InputFormat{"vtu", "VTK XML volume mesh", read_vtk_xml},
    InputFormat{"mesh", "MEDIT mesh", read_medit},
    InputFormat{"msh", "Gmsh 2.2 or 4.1", read_gmsh},
    InputFormat{"inp", "AVS UCD", read_ucd},
    InputFormat{"pol", "lines, 999 between them", read_pol},
    InputFormat{"gri", "IRAP classic surface, binary or text", read_irap},
    InputFormat{"geo", "Gmsh section", read_geo},
    InputFormat{"grdecl", "corner-point grid, Eclipse keywords", read_grdecl},
    InputFormat{"roff", "corner-point grid, ROFF", read_roff},
};

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool ends_with(const std::string& text, std::string_view ending) {
  return text.size() >= ending.size() && std::string_view(text).substr(text.size() - ending.size()) == ending;
}

std::string ending_of(std::string name) {
  name = lower_case(std::move(name));
  if (ends_with(name, ".gz")) name.resize(name.size() - 3);
  const std::size_t dot = name.find_last_of("./");
  return dot == std::string::npos || name[dot] == '/' ? std::string() : name.substr(dot + 1);
}

bool starts_like_gocad(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes.substr(first, 6) == "GOCAD ";
}

/// Many files end in .txt: only `B n` or `F n` on the first line makes it a fault map.
bool is_fault_map(std::string_view bytes, const std::string& ending) {
  return ending == "txt" && bytes.size() > 2 && (bytes[0] == 'B' || bytes[0] == 'F') && bytes[1] == ' ' &&
         bytes[2] >= '0' && bytes[2] <= '9';
}

const InputFormat* format_of(const std::string& ending) {
  for (const InputFormat& format : formats)
    if (format.ending == ending) return &format;
  return nullptr;
}

Failure unknown_ending(const std::string& file_name, const std::string& ending) {
  std::string known;
  for (const InputFormat& format : formats) known += (known.empty() ? "." : " .") + std::string(format.ending);
  if (ending == "sfm")
    return Failure{FailureCode::unsupported, file_name + ": a model file inside a packed one is not read",
                   "unpack it: its parts are loaded from the file itself"};
  return Failure{
      FailureCode::unsupported,
      file_name + ": " + (ending.empty() ? "a file without an ending" : "files ending in ." + ending) + " are not read",
      "supported are " + known + ", each also gzipped (.gz), .tar, .tar.gz, .tgz archives of them, and .sfm"};
}

Result<InputData> read_archive(std::string_view bytes, const std::string& file_name) {
  const Result<std::vector<TarMember>> members = tar_members(bytes, file_name);
  if (!members) return members.failure();
  std::vector<InputData> parts;
  std::vector<Warning> skipped;
  for (const TarMember& member : *members) {
    const std::string name = file_name + "/" + member.name;
    if (!format_of(ending_of(member.name)) && !is_fault_map(member.content, ending_of(member.name))) {
      skipped.push_back({"skipped_member", name + ": is not of a format that is read"});
      continue;
    }
    std::string unpacked;
    std::string_view content = member.content;
    if (is_gzip(content)) {
      Result<std::string> text = unpack_gzip(content, name);
      if (!text) return text.failure();
      content = unpacked = std::move(*text);
    }
    Result<InputData> part = read_input_bytes(content, name);
    if (!part) return part;
    parts.push_back(std::move(*part));
  }
  if (parts.empty())
    return Failure{FailureCode::malformed_file, file_name + ": the archive holds no file that can be read",
                   "put model or surface files into it"};
  Result<InputData> all = combine_inputs(std::move(parts));
  if (all) all->warnings.insert(all->warnings.end(), skipped.begin(), skipped.end());
  return all;
}

/// A native model file, its local origin undone (exactly: it was chosen so that the shift has no rounding error).
Result<InputData> read_native_model(const std::filesystem::path& path) {
  const Result<StructuralModel> model = read_model_file(path);
  if (!model) return model.failure();
  InputData data;
  data.surfaces = soup_of_model(*model);
  for (Vec3& point : data.surfaces.points) point = point + model->local_origin;
  data.surfaces.local_origin = {};
  return data;
}

}  // namespace

std::span<const InputFormat> input_formats() { return formats; }

Result<InputData> read_input_bytes(std::string_view bytes, const std::string& file_name) {
  const std::string ending = ending_of(file_name);
  if (ending == "tar" || ending == "tgz") return read_archive(bytes, file_name);
  if (starts_like_gocad(bytes)) return read_gocad(bytes, file_name);
  if (is_fault_map(bytes, ending)) return read_fault_map(bytes, file_name);
  const InputFormat* format = format_of(ending);
  if (!format) return unknown_ending(file_name, ending);
  return format->read(bytes, file_name);
}

Result<InputData> read_input(const std::filesystem::path& path) {
  if (lower_case(path.extension().string()) == ".sfm") return read_native_model(path);
  const Result<std::string> text = read_input_text(path);
  if (!text) return text.failure();
  const std::string name = path.filename().string();
  if (ending_of(name) == "geo")
    return read_geo_including(*text, name, [&](const std::string& included) {
      return read_input_text(path.parent_path() / included);
    });
  return read_input_bytes(*text, name);
}

std::vector<std::string> included_texts(const std::filesystem::path& path) {
  std::vector<std::string> texts;
  if (ending_of(path.filename().string()) != "geo") return texts;
  const Result<std::string> text = read_input_text(path);
  if (text)  // what is wrong with it is told when it is read
    (void)read_geo_including(*text, {}, [&](const std::string& included) {
      Result<std::string> found = read_input_text(path.parent_path() / included);
      if (found) texts.push_back(*found);
      return found;
    });
  return texts;
}

}  // namespace strataflow
