#pragma once
#include <cstdint>
#include <vector>

#include "kernels/topology/building/edge_table.h"
#include "model/structural_model.h"
#include "model/validity_report.h"

namespace strataflow {

/// Gives every region the name of the file's record that shares most of its patches, or "region_<number>", and
/// rebuilds the file's layers. `patches_of_surface` tells which patches each surface came from.
void name_regions(StructuralModel& model, const TriangleSoup& soup,
                  const std::vector<std::vector<std::uint32_t>>& patches_of_surface);

/// Border records that do not start along an edge of their own surface on a minimal line, and stones on no line, are
/// `inconsistent_border` (error: rebuilt on repair); stones in the middle of a line are `superfluous_border_stone`
/// (warning). `id_of_point`: the model's vertex of each soup point, no_index for points no triangle uses.
std::vector<Violation> compare_borders(const StructuralModel& model, const EdgeTable& edges, const TriangleSoup& soup,
                                       const std::vector<std::uint32_t>& id_of_point);

/// A surface whose sides the file puts into different regions while space joins them is a `leak`.
std::vector<Violation> compare_region_records(const StructuralModel& model, const TriangleSoup& soup,
                                              const std::vector<std::vector<std::uint32_t>>& patches_of_surface);

}  // namespace strataflow
