#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/mesh/write_abaqus.h"
#include "io/mesh/write_gmsh.h"
#include "io/mesh/write_medit.h"
#include "io/surface/write_obj.h"
#include "io/vtk/write_vtk_xml.h"
#include "model/input_data.h"

namespace strataflow {

/// Whatever the bytes: a value or a named failure; what was read is sound, and every writer takes it.
inline int check_mesh_reader(Result<InputData> (*read)(std::string_view, const std::string&),
                             const std::string& file_name, const std::uint8_t* data, std::size_t size) {
  const Result<InputData> input = read(std::string_view(reinterpret_cast<const char*>(data), size), file_name);
  if (!input) {
    STRATAFLOW_ASSERT(input.failure().what.find("fuzz.") != std::string::npos, "a failure that does not name the file");
    STRATAFLOW_ASSERT(!input.failure().remedy.empty(), "a failure without a remedy");
    return 0;
  }
  const TriangleSoup& soup = input->surfaces;
  STRATAFLOW_ASSERT(soup.triangle_patch.size() == soup.triangles.size(), "a triangle without a patch");
  for (const Triangle& triangle : soup.triangles)
    for (const std::uint32_t vertex : triangle) STRATAFLOW_ASSERT(vertex < soup.points.size(), "vertex out of range");
  for (const std::uint32_t patch : soup.triangle_patch)
    STRATAFLOW_ASSERT(patch < soup.patch_entity.size(), "patch out of range");
  for (const std::uint32_t entity : soup.patch_entity)
    STRATAFLOW_ASSERT(entity < soup.entities.size(), "entity out of range");
  for (const PointProperty& property : soup.properties)
    STRATAFLOW_ASSERT(property.values.size() == soup.points.size() * property.width, "property of another length");
  for (const Vec3& point : soup.points) STRATAFLOW_ASSERT(is_finite(point), "a point that is not finite");
  const VolumeMesh& mesh = input->volume;
  STRATAFLOW_ASSERT(mesh.cell_offsets.size() == mesh.cell_count() + 1, "offsets of another length");
  for (const std::uint32_t vertex : mesh.cell_vertices)
    STRATAFLOW_ASSERT(vertex < mesh.points.size(), "cell vertex out of range");
  const std::size_t written = write_vtp(labelled_triangles(soup)).size() + write_obj(labelled_triangles(soup)).size() +
                              write_vtu(mesh).size() + write_medit(mesh).size() + write_gmsh(mesh).size() +
                              write_abaqus(mesh).size();
  STRATAFLOW_ASSERT(written > 0, "nothing was written");
  return 0;
}

}  // namespace strataflow
