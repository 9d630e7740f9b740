#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/hexes/stratigraphic_function.h"
#include "model/input_data.h"

namespace strataflow {

/// A model that hexahedra can be extruded in: its tetrahedra in XYZ, in the plan (U, V) where faults stand upright, and
/// in W where horizons are flat (coudert2024 S9).
struct LayeredSpace {
  LabelledTets model;
  StratigraphicLevels levels;
  std::vector<Vec3> plan;  ///< per point of the model: u, v, 0
  StratigraphicTets layers;
  std::vector<std::uint32_t> flipped;      ///< of layers.tets, not positive in UVW: slivers that lifting leaves aside
  std::vector<Polyline> lines;             ///< what quads over the plan must follow (plan_lines)
  std::uint32_t turned_over_at_first = 0;  ///< tetrahedra the linear deformation turned over, before untangling
  std::uint32_t untangling_steps = 0;
  std::vector<Change> changes;
  template <class A>
  void archive(A& a) {
    a(model, levels, plan, layers, flipped, lines, turned_over_at_first, untangling_steps, changes);
  }
};

/// A model in its plan, where faults stand upright, before it has layers.
struct UprightModel {
  LabelledTets model;
  StratigraphicLevels levels;
  std::vector<Vec3> plan;                  ///< per point of the model: u, v, 0
  std::vector<Polyline> lines;             ///< what quads over the plan must follow (plan_lines)
  std::uint32_t turned_over_at_first = 0;  ///< as in LayeredSpace
  std::uint32_t untangling_steps = 0;
  template <class A>
  void archive(A& a) {
    a(model, levels, plan, lines, turned_over_at_first, untangling_steps);
  }
};

struct LayeredSpaceOptions {
  std::vector<std::string> drop_alignment;  ///< entities that need not be followed
  LayerOptions layers;
  bool follow_horizon_lines = false;    ///< lines where horizons meet are among `lines` (S19)
  std::int64_t untangling_steps = 600;  ///< ≥ 0: at most, where faults are far from upright
};

/// The model as it stands: labels, levels, nothing upright; its plan is what is seen from above. Faults that need not
/// be followed and displace nothing are forgotten. Fails with what label_tets and find_stratigraphic_levels fail with.
Result<UprightModel> take_model(const VolumeMesh& mesh, const std::vector<std::string>& drop_alignment = {});

/// From the tetrahedra of a model to their plan: labels, levels, upright faults; `options.layers` says nothing here.
/// Fails with what label_tets, find_stratigraphic_levels and verticalise fail with.
Result<UprightModel> make_upright(const VolumeMesh& mesh, const LayeredSpaceOptions& options = {});

/// From the tetrahedra of a model to its layered space: make_upright, then build_layered_space.
Result<LayeredSpace> make_layered_space(const VolumeMesh& mesh, const LayeredSpaceOptions& options = {});

/// Ends the way into layers for a model whose plan is known: finds W, and splits edges of tetrahedra that come out
/// flipped until all is positive (R9) or nothing more helps. Fails with what find_stratigraphic_function fails with,
/// and with geometry_failed, naming the region, when more than 1/10 000 of the volume stays flipped.
Result<LayeredSpace> build_layered_space(LabelledTets model, StratigraphicLevels levels, std::vector<Vec3> plan,
                                         const LayerOptions& options = {});
Result<LayeredSpace> build_layered_space(UprightModel upright, const LayerOptions& options = {});

}  // namespace strataflow
