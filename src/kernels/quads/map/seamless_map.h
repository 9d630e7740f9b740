#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/quads/field/frame_field.h"
#include "kernels/quads/map/optimise_map.h"

namespace strataflow {

struct FieldAndMap {
  FrameFieldResult field;
  OptimisedMap map;
  std::vector<std::string> retries;    ///< why earlier fields were given up; empty when the first one did
  std::vector<std::uint32_t> loose{};  ///< features that neither follows, ascending: without_features() is their mesh
  template <class A>
  void archive(A& a) {
    a(field, map, retries, loose);
  }
};

/// The fields that are tried one after the other: first the one asked for, then with fewer and with more singular
/// points.
std::vector<FrameFieldOptions> alternative_fields(const FrameFieldOptions& asked);

/// A frame field and the valid seamless map that follows it (coudert2024 S5, S35 first line). Where a field's map stays
/// folded or winds, the next of alternative_fields is tried. Fails with the reason
/// of the first attempt; `stuck` gets the triangles that it left folded. `first`: the field to begin with, where those
/// before are known to fail.
Result<FieldAndMap> compute_seamless_map(const FeatureMesh& mesh, const FrameFieldOptions& field_options = {},
                                         const FoldoverFreeOptions& map_options = {},
                                         std::vector<std::uint32_t>* stuck = nullptr, std::size_t first = 0);

}  // namespace strataflow
