#pragma once
#include "model/built_model.h"

namespace strataflow {

/// Checks a built model against the rules for a static one (A1–A16 of euler1999 §3, I1–I6 of pellerin2014 §3) and
/// returns every violation found, those of the construction included. Exact: the intersection census equals testing
/// all pairs of the input's triangles, the identical ones that building merged among them.
ValidityReport check_validity(const BuiltModel& built);

/// The outer shell is closed, and no two triangles of the model meet improperly or without conforming.
bool is_sealed(const StructuralModel& model, const ValidityReport& report);

}  // namespace strataflow
