#pragma once
#include <cstdint>
#include <vector>

#include "kernels/complexity/box_elements.h"
#include "kernels/complexity/cells/cell_pieces.h"
#include "kernels/complexity/geometric_complexity.h"
#include "model/structural_model.h"

namespace strataflow {

/// What counts as one line or surface of a cell. Regions count by element in both ways.
enum class CountBy : std::uint32_t {
  components,  ///< each connected piece of a surface, line inside the cell
  elements,    ///< each surface, line of the model that shows in the cell
  /// Each connected piece of a feature inside the cell: contacts do not split it, and lines and corners do not count.
  /// This is what Table 3.4 of the thesis agrees with.
  features
};

/// What is in one cell, the box's surfaces, lines and corners left out.
struct CellCount {
  std::uint32_t regions = 0, surfaces = 0, lines = 0, corners = 0;  ///< regions 0: the cell lies outside the model
  double area_m2 = 0;          ///< of surfaces
  double length_m = 0;         ///< of lines
  double roughness_ratio = 0;  ///< 1 − projection of all its surfaces on their mean plane / area
  double thin_ratio = 0;       ///< share of its surfaces' sides, by triangle, over a region thinner than h
  double sharp_ratio = 0;      ///< share of its lines, by edge, where regions end sharper than the angle
  /// Edge length that still resolves what is here: the least of the regions' thickness at the surfaces of the cell (by
  /// triangle, as far as it is below h, not where a region wedges out), the lengths of its lines, the roots of its
  /// surfaces' areas; at most the cell's own width.
  double needed_edge_m = 0;
  std::uint32_t total() const { return regions + surfaces + lines + corners; }
  static constexpr bool is_flat = true;
};

/// Counts in every cell (pellerin2014 §2.10d). Regions are those on the sides of the surfaces in the cell, or the one
/// around its site.
std::vector<CellCount> count_in_cells(const StructuralModel& model, const BoxElements& box,
                                      const GeometricSamples& samples, const GeometricComplexity& geometric,
                                      const CellPieces& pieces, CountBy by = CountBy::components);

/// How the counts of the cells inside the model are spread. Quantile q of n values is the ⌈q n⌉-th smallest.
struct CellStatistics {
  std::uint64_t cells = 0;
  double resolution_m = 0;
  std::uint32_t q10 = 0, q50 = 0, q90 = 0, max = 0;
  double mean = 0;
  double cv = 0;              ///< standard deviation of a sample over mean
  std::uint64_t above_6 = 0;  ///< cells with more than 6
  double needed_edge_m = 0;   ///< that 99 % of the cells would do with
  template <class A>
  void archive(A& a) {
    a(cells, resolution_m, q10, q50, q90, max, mean, cv, above_6, needed_edge_m);
  }
};

CellStatistics statistics_of(const std::vector<CellCount>& counts, double resolution_m);

}  // namespace strataflow
