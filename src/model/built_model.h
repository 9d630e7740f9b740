#pragma once
#include <cstdint>
#include <vector>

#include "model/structural_model.h"
#include "model/validity_report.h"

namespace strataflow {

/// One of several identical input triangles.
struct TriangleCopy {
  std::uint32_t triangle = 0;  ///< of the model, which stands for it
  std::uint32_t entity = 0;    ///< it came from; the youngest, if from a patch of several
  static constexpr bool is_flat = true;
};

/// A model with what its construction found wrong. Building never stops at a flaw: it drops what has no volume or
/// area (and says so), and leaves the rest to be judged.
struct BuiltModel {
  StructuralModel model;
  std::vector<Violation> violations;
  /// Input triangles that became one with identical ones, ascending by triangle; one that nothing repeats is not here.
  std::vector<TriangleCopy> copies;
  template <class A>
  void archive(A& a) {
    a(model, violations, copies);
  }
};

}  // namespace strataflow
