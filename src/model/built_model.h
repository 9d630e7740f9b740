#pragma once
#include <vector>

#include "model/structural_model.h"
#include "model/validity_report.h"

namespace strataflow {

/// A model with what its construction found wrong. Building never stops at a flaw: it drops what has no volume or
/// area (and says so), and leaves the rest to be judged.
struct BuiltModel {
  StructuralModel model;
  std::vector<Violation> violations;
  template <class A>
  void archive(A& a) {
    a(model, violations);
  }
};

}  // namespace strataflow
