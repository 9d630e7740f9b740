#pragma once
#include <string>

#include "io/input/labelled_triangles.h"
#include "model/volume_mesh.h"

namespace strataflow {

// VTK XML, appended raw binary, zlib, UInt64 headers: what VTK, ParaView and meshio read. Coordinates are the input's
// own (point + local_origin). The same content gives the same bytes.

/// Triangles with cell arrays `surface`, `entity`; point arrays `line`, `corner` (-1 elsewhere) and the properties;
/// field data `entity_names`, `entity_roles` (strings).
std::string write_vtp(const LabelledTriangles& surfaces);

/// Cells with `region` and `entity` (-1: none); point arrays `line`, `corner` when the mesh has them. Field data
/// `region_names` and `entity_names` are UTF-8 bytes (UInt8), each name ended by a zero: meshio refuses whole files
/// that hold VTK's string arrays.
std::string write_vtu(const VolumeMesh& mesh);

/// The facets of a mesh, with cell arrays `surface`, `entity`, `cell_0`, `cell_1` (-1: outside). Points are numbered as
/// in `write_vtu`. Field data as in `write_vtp`.
std::string write_facets_vtp(const VolumeMesh& mesh);

}  // namespace strataflow
