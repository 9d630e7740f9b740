#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/remeshing/dual/dual_soup.h"

namespace strataflow {

enum class ElementKind : std::uint8_t { corner, line, surface, region };
enum class ChangeKind : std::uint8_t {
  lost,    ///< nothing in the new model comes from it
  merged,  ///< several old ones are one new one
  split,   ///< one old one is several
  created  ///< a new one that comes from none
};

std::string_view to_string(ElementKind kind);
std::string_view to_string(ChangeKind kind);

/// One thing that is not as it was.
struct ElementChange {
  ElementKind element = ElementKind::corner;
  ChangeKind kind = ChangeKind::lost;
  std::vector<std::uint32_t> before;  ///< elements of the old model, ascending
  std::vector<std::uint32_t> after;   ///< elements of the new one, ascending
};

/// The change in words, with the names of features and regions.
std::string describe(const ElementChange& change, const StructuralModel& before, const StructuralModel& after);

/// Which elements of a model became which of the one built from its dual, by where points and triangles came from
/// and never by distance: a corner by its point, a line by its edges, a surface by its patch, a region by the sides
/// of surfaces around it. What is not listed is there, alone, in both. Ascending by element and kind.
std::vector<ElementChange> compare_elements(const StructuralModel& before, const DualSoup& dual,
                                            const StructuralModel& after);

}  // namespace strataflow
