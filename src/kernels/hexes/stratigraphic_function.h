#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/hexes/stratigraphic_levels.h"

namespace strataflow {

/// How layers share the thickness of their unit: all the same part of it; or all equally thick, counted down from its
/// roof or up from its floor, the last one taking what is left. Where a unit is thinner than that, the layers share
/// what there is, so that all stay positive.
enum class LayerLayout : std::uint8_t { proportional, parallel_to_top, parallel_to_base };

/// How many layers of hexahedra each unit gets. A unit is called by the horizon that is its roof, or "Top".
struct LayerOptions {
  std::int64_t layers = 4;                          ///< ≥ 1: of units that are not named
  std::map<std::string, std::int64_t> unit_layers = {};  ///< ≥ 1, by unit
  std::optional<double> thickness_m;                ///< > 0: count from the mean thickness instead
  LayerLayout layout = LayerLayout::proportional;   ///< of units that are not named
  std::map<std::string, LayerLayout> unit_layout = {};  ///< by unit
};

/// The layers of one unit.
struct UnitLayers {
  LayerLayout layout = LayerLayout::proportional;
  double thickness_m = 0;  ///< of parallel layers: LayerOptions::thickness_m, or the unit's mean over its layers
  template <class A>
  void archive(A& a) {
    a(layout, thickness_m);
  }
};

/// Tetrahedra with a place in three spaces: XYZ (`point`), the plan (by point) and W. The first are those of the model,
/// let go of each other at faults; then come those without volume in XYZ that make every level separate what lies
/// below from what lies above (coudert2024 S13b).
struct StratigraphicTets {
  std::vector<std::uint32_t> point;      ///< per copy: its point in LabelledTets
  std::vector<double> w;                 ///< per copy; whole numbers on horizons
  std::vector<Tet> tets;                 ///< vertices are copies
  std::vector<std::uint32_t> neighbour;  ///< per face 4·t + k; no_index outside and at faults
  std::uint32_t model_tets = 0;          ///< how many are those of the model
  std::vector<std::uint32_t> level_w;    ///< per level: its W
  std::vector<std::string> level_names;
  std::vector<UnitLayers> units;         ///< between levels, from below
  template <class A>
  void archive(A& a) {
    a(point, w, tets, neighbour, model_tets, level_w, level_names, units);
  }
  std::uint32_t layer_count() const { return level_w.back(); }
};

/// The function whose whole values are the boundaries of layers (coudert2024 S12): harmonic, W of each
/// horizon on both sides of every fault. The weights are those of linear elements (cotangents), so that W is linear
/// between parallel horizons however flat a tetrahedron is; where they let W leave its unit, the mean of the neighbours
/// takes its place. One solve, which starts from `near`: what was found before some of the tetrahedra were split, or
/// null. `tets` should have gone through split_level_chords. Fails with: invalid_options; unsupported (a compartment
/// without level, named by its region); geometry_failed (more than 2³⁰ tetrahedra, a solve that does not end).
Result<StratigraphicTets> find_stratigraphic_function(const LabelledTets& tets, const StratigraphicLevels& levels,
                                                      const LayerOptions& options = {},
                                                      const StratigraphicTets* near = nullptr);

/// The tetrahedra that are not positive in (U, V, W), or so flat there that rounding decides, where `plan` holds (u, v)
/// per point of the model (R9); ascending.
std::vector<std::uint32_t> flipped_in_layers(const StratigraphicTets& tets, const std::vector<Vec3>& plan);

}  // namespace strataflow
