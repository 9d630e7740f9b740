#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/hexes/labelled_tets.h"

namespace strataflow {

/// The order of the horizons: level 0 is the bottom of the domain, the last its top. Unit k lies between levels k and
/// k + 1.
struct StratigraphicLevels {
  std::vector<std::string> names;       ///< per level
  std::vector<std::uint32_t> level_of;  ///< per entity: its level; no_index if it is no horizon
  std::vector<std::uint32_t> unit;      ///< per tet
  std::vector<Change> changes;          ///< triangles of horizons that were passed over
  template <class A>
  void archive(A& a) {
    a(names, level_of, unit, changes);
  }
  std::uint32_t unit_count() const { return static_cast<std::uint32_t>(names.size()) - 1; }
};

/// Sorts the horizons by what lies over what (coudert2024 S12, step 1); where that leaves a choice, the lower one on
/// average comes first. A part of the model between levels that are not consecutive belongs to the lowest unit of
/// these, or to the highest where its floor is one that others end on from above. Triangles of a horizon that lie the
/// wrong way round, or end inside a region, are passed over up to a hundredth of it and told in `changes`. Fails with
/// unsupported, naming the entity: a horizon below and above the same region (overturned, or ending inside it),
/// horizons in a circle.
Result<StratigraphicLevels> find_stratigraphic_levels(const LabelledTets& tets);

}  // namespace strataflow
