#pragma once
#include <string>

namespace strataflow {

/// Something a user should know that did not stop the work. `kind` is a stable snake_case word, `what` names the
/// entity or file:line. Warnings are data: they travel with the output they are about.
struct Warning {
  std::string kind;
  std::string what;
  template <class A>
  void archive(A& a) {
    a(kind, what);
  }
};

}  // namespace strataflow
