#pragma once
#include <cstddef>
#include <filesystem>
#include <string_view>

#include "kernels/hybrid/shared_surfaces.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"

namespace strataflow::support {

inline std::filesystem::path tet_worker() {
  return std::filesystem::path(STRATAFLOW_BINARY_DIR) / "bin" / "tet_worker";
}

/// A generated model with `count` sites on its surfaces, which edges of `edge_m` need about.
inline StructuralModel remeshed(std::string_view name, std::size_t count, double edge_m) {
  const StructuralModel model = build_structural_model(*generate_reference_model(name))->model;
  SharedSitesOptions drawing;
  drawing.surface_edge_length_m.assign(model.surfaces.size(), edge_m);
  drawing.thin_ratio = 1;
  SharedSurfacesOptions options;
  options.settle.rounds = 2;
  return remesh_on_shared_sites(model, draw_shared_sites(model, count, drawing), options)->built.model;
}

}  // namespace strataflow::support
