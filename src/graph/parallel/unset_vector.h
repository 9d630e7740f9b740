#pragma once
#include <memory>
#include <utility>
#include <vector>

namespace strataflow {

/// Leaves the items of trivial types unset where std::vector would clear them.
template <class T>
struct UnsetAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) == 0)
      ::new (static_cast<void*>(place)) U;
    else
      std::construct_at(place, std::forward<Arguments>(arguments)...);
  }
};

/// A large array of which parallel loops write every item before anyone reads it: no serial pass clears it first, and
/// its memory is first touched by the thread that fills it. T has no initialisers.
template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

}  // namespace strataflow
