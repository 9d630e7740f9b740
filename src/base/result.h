#pragma once
#include <optional>
#include <utility>
#include <variant>

#include "base/failure.h"
#include "base/internal_error.h"

namespace strataflow {

/// A value, or the reason why there is none. Never empty; reading the wrong side is our bug.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Failure failure) : state_(std::in_place_index<1>, std::move(failure)) {}

  explicit operator bool() const { return state_.index() == 0; }

  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(value()); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  T& value() {
    STRATAFLOW_ASSERT(state_.index() == 0, "value of a failed Result");
    return std::get<0>(state_);
  }
  const T& value() const {
    STRATAFLOW_ASSERT(state_.index() == 0, "value of a failed Result");
    return std::get<0>(state_);
  }
  const Failure& failure() const {
    STRATAFLOW_ASSERT(state_.index() == 1, "failure of a Result that holds a value");
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Failure> state_;
};

/// Success without a value, or the reason why not.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Failure failure) : failure_(std::move(failure)) {}
  explicit operator bool() const { return !failure_; }
  const Failure& failure() const {
    STRATAFLOW_ASSERT(failure_.has_value(), "failure of a Result that succeeded");
    return *failure_;
  }

 private:
  std::optional<Failure> failure_;
};

}  // namespace strataflow
