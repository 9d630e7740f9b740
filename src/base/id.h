#pragma once
#include <compare>
#include <cstdint>

namespace strataflow {

/// "None" where an index is expected.
constexpr std::uint32_t no_index = 0xffffffffu;

/// An index that cannot be mistaken for an index of something else: `Id<struct NodeTag>` and `Id<struct LineTag>`
/// are different types. Four bytes, ordered, no arithmetic.
template <class Tag>
struct Id {
  std::uint32_t value = 0;
  friend constexpr auto operator<=>(Id, Id) = default;
};

}  // namespace strataflow
