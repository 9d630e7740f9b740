#pragma once
#include <span>
#include <string>

#include "io/input/labelled_triangles.h"
#include "model/cell_field.h"
#include "model/corner_map.h"
#include "model/input_data.h"
#include "model/quad_mesh.h"
#include "model/restricted_diagram.h"
#include "model/volume_mesh.h"

namespace strataflow {

// VTK XML, appended raw binary, zlib, UInt64 headers: what VTK, ParaView and meshio read. Coordinates are the input's
// own (point + local_origin). The same content gives the same bytes.

/// Triangles with cell arrays `surface`, `entity`; point arrays `line`, `corner` (-1 elsewhere) and the properties;
/// field data `entity_names`, `entity_roles` (strings).
std::string write_vtp(const LabelledTriangles& surfaces);

/// The pieces of cells of a diagram restricted to these triangles, as polygons that share their corners; cell arrays
/// `site`, `surface`, `entity`, `triangle`.
std::string write_voronoi_vtp(const LabelledTriangles& surfaces, const RestrictedDiagram& diagram);

/// Cells with `region` and `entity` (-1: none); point arrays `line`, `corner` when the mesh has them. Field data
/// `region_names` and `entity_names` are UTF-8 bytes (UInt8), each name ended by a zero: meshio refuses whole files
/// that hold VTK's string arrays.
std::string write_vtu(const VolumeMesh& mesh);

/// The same with further cell arrays: one value per cell, or three as a vector. Other fields are left out.
std::string write_vtu(const VolumeMesh& mesh, std::span<const CellField> fields);

/// The facets of a mesh, with cell arrays `surface`, `entity`, `cell_0`, `cell_1` (-1: outside). Points are numbered as
/// in `write_vtu`. Field data as in `write_vtp`.
std::string write_facets_vtp(const VolumeMesh& mesh);

/// Quads as polygons, and before them one line per quad edge on a feature; cell array `feature` (-1: a quad). Field data
/// `feature_names`, `feature_roles` (strings).
std::string write_quads_vtp(const QuadMesh& mesh);

/// Lines as polylines, closed ones back to their first point; cell array `line`; field data `line_names`.
std::string write_lines_vtp(std::span<const Polyline> lines, const Vec3& local_origin);

/// The triangulation that quads are made on, and before it one line per edge on a feature, as write_quads_vtp has them.
/// Point array `corner` (1: becomes a vertex of quads). With a field: `valence` (point array, of quads to be) and the
/// directions `direction_0`, `direction_1` (cell arrays, unit vectors in the triangle; 0 on lines). With a map: `valence`
/// too, and triangles share no points, so that these can carry `u` and `v` (0 on lines).
std::string write_feature_mesh_vtp(const FeatureMesh& mesh, const FrameField* field, const CornerMap* map);

}  // namespace strataflow
