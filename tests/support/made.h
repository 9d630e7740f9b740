#pragma once
#include <gtest/gtest.h>

#include "base/result.h"

namespace strataflow::support {

/// The value, or a test that fails with the reason there is none.
template <class T>
T made(Result<T> result) {
  EXPECT_TRUE(result) << describe(result.failure());
  return result ? *std::move(result) : T{};
}

}  // namespace strataflow::support
