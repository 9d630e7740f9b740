#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/complexity/box_elements.h"
#include "kernels/complexity/contact_wedges.h"
#include "kernels/complexity/region_thickness.h"
#include "kernels/topology/building/edge_table.h"
#include "model/structural_model.h"

namespace strataflow {

enum class ElementType : std::uint32_t { region, surface, line };

/// How hard one element is to mesh with edges of length h (pellerin2014 §2.10b). Each part is in [0, 1].
struct ElementComplexity {
  ElementType type = ElementType::region;
  std::uint32_t element = 0;
  double size = 0;       ///< m³, m², m
  double too_small = 0;  ///< C_t: 1 if size ≤ h^d
  double shape = 0;      ///< C_f: 1 − size of its projection on its mean plane (segment) / size; regions: 0
  double thin = 0;       ///< C_e: share of its boundary where it is thinner than h; lines: 0
  /// C_a. Regions: share of the length of their lines along which they end in an edge sharper than the angle. Surfaces:
  /// share of their corners (those on the box count as blunt) where two of their borders meet at less. Lines: 0.
  double sharp = 0;
  static constexpr bool is_flat = true;
  double total() const { return too_small + shape + thin + sharp; }
};

struct GeometricComplexity {
  double edge_length_m = 0;       ///< h
  double angle_deg = 0;           ///< α
  double spacing_m = 0;           ///< of thickness samples; at most h / 2 unless there were too many
  std::vector<ElementComplexity> elements;  ///< regions, surfaces, lines, without the box's
  ElementComplexity sum_of(ElementType type) const;  ///< `element` tells how many there are
  double total() const;
  template <class A>
  void archive(A& a) {
    a(edge_length_m, angle_deg, spacing_m, elements);
  }
};

/// What the geometric measures are made of, to be used again cell by cell.
struct GeometricSamples {
  EdgeTable edges;
  ThicknessSamples thickness;
  std::vector<ContactWedge> wedges;
};

/// Thickness is sampled at h / 2 and looked for up to h. Projections count every fold (no union). Needs h > 0.
GeometricSamples sample_geometry(const StructuralModel& model, const BoxElements& box, double edge_length_m);
GeometricComplexity measure_geometric_complexity(const StructuralModel& model, const BoxElements& box,
                                                 const GeometricSamples& samples, double edge_length_m,
                                                 double angle_deg);

/// Standard deviation (of a sample: n − 1, which is what Table 3.3 has) over mean of the sizes of each type
/// (pellerin2014 §2.10c); NaN for a type with fewer than two elements.
struct SizeVariation {
  double regions = 0, surfaces = 0, lines = 0;
  double total() const;  ///< of those that are not NaN
  static constexpr bool is_flat = true;
};
SizeVariation measure_size_variation(const GeometricComplexity& complexity);

}  // namespace strataflow
