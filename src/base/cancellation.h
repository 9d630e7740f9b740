#pragma once
#include <atomic>

namespace strataflow {

/// Asked from anywhere (also from a signal handler) to stop; looked at by long loops. Never reset.
class CancellationToken {
 public:
  void cancel() { requested_.store(true, std::memory_order_relaxed); }
  bool is_cancelled() const { return requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
};

}  // namespace strataflow
