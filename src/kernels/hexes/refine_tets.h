#pragma once
#include "kernels/hexes/stratigraphic_function.h"

namespace strataflow {

/// Splits edges through a unit that join two points of one level without lying on that horizon: a tetrahedron with
/// all corners on one level would be flat where horizons are (R9). `levels.unit` follows, and so does `plan`, a
/// position per point, if there is one. Returns how many were split.
std::size_t split_level_chords(LabelledTets& tets, StratigraphicLevels& levels, std::vector<Vec3>* plan = nullptr);

/// Splits both diagonals of each of the `flipped` tetrahedra that is a flat quadrilateral in (U, V, W), so that they
/// can bend away from each other. Diagonals along horizons stay. Returns how many were split.
std::size_t split_flat_diagonals(LabelledTets& tets, StratigraphicLevels& levels, std::vector<Vec3>& plan,
                                 const StratigraphicTets& layers, const std::vector<std::uint32_t>& flipped);

/// Splits edges that join two points of walls without lying on all sheets they have in common: a tetrahedron with all
/// corners on walls can be flat once these stand upright. Returns how many were split.
std::size_t split_wall_chords(LabelledTets& tets, StratigraphicLevels& levels);

/// Splits tetrahedra with several faces on faults and sides at their centres, so that each has one at most: then a
/// field that is constant in each can follow all of them (coudert2024 S17). Returns how many were split.
std::size_t separate_walls(LabelledTets& tets, StratigraphicLevels& levels);

}  // namespace strataflow
