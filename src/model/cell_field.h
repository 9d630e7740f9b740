#pragma once
#include <string>
#include <vector>

namespace strataflow {

/// A value per cell of a mesh.
struct CellField {
  std::string name;
  std::vector<double> values;
  template <class A>
  void archive(A& a) {
    a(name, values);
  }
};

}  // namespace strataflow
