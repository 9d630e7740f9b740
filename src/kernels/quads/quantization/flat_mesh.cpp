#include "kernels/quads/quantization/flat_mesh.h"

namespace strataflow {

LinearForm combine(const LinearForm& a, int turns_a, const LinearForm& b, int turns_b) {
  LinearForm sum;
  sum.reserve(a.size() + b.size());
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (j == b.size() || (i < a.size() && a[i].variable < b[j].variable)) {
      sum.push_back({a[i].variable, turned(a[i].coefficient, turns_a)});
      ++i;
    } else if (i == a.size() || b[j].variable < a[i].variable) {
      sum.push_back({b[j].variable, turned(b[j].coefficient, turns_b)});
      ++j;
    } else {
      const auto total = turned(a[i].coefficient, turns_a) + turned(b[j].coefficient, turns_b);
      if (!(total == GaussianInteger{})) sum.push_back({a[i].variable, total});
      ++i;
      ++j;
    }
  }
  return sum;
}

}  // namespace strataflow
