#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "model/vector3.h"

namespace strataflow {

/// A broken validity rule, or (severity warning) something odd that a valid model may hold. docs/validity.md lists
/// every kind.
struct Violation {
  enum class Severity : std::uint8_t { warning, error };
  std::string kind;  ///< stable word: open_shell, leak, non_conforming_contact, improper_intersection …
  Severity severity = Severity::error;
  std::string what;    ///< names the entities and counts
  std::string remedy;  ///< what to do next
  Vec3 where;          ///< one place to look at, relative to the model's local origin
  std::uint64_t count = 1;
  bool is_mended = false;  ///< building the model already mended it (dropped, rebuilt): `run` goes on after it
  template <class A>
  void archive(A& a) {
    a(kind, severity, what, remedy, where, count, is_mended);
  }
};

/// Outcome of checking a model: rules A1–A24 (euler1999 §3) and I1–I6 (pellerin2014 §3) that apply to a static one.
struct ValidityReport {
  std::uint64_t intersecting_triangle_pairs = 0;  ///< among input triangles, identical ones included
  std::uint64_t self_intersecting_pairs = 0;      ///< of these, both triangles in one entity
  std::uint64_t identical_triangle_pairs = 0;     ///< of these, the triangles building the model made one
  std::vector<Violation> violations;          ///< ordered by kind, then by the first entity they name
  bool is_valid() const {
    for (const Violation& violation : violations)
      if (violation.severity == Violation::Severity::error) return false;
    return true;
  }
  template <class A>
  void archive(A& a) {
    a(intersecting_triangle_pairs, self_intersecting_pairs, identical_triangle_pairs, violations);
  }
};

}  // namespace strataflow
