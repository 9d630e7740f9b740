#pragma once

// The packaged oneTBB is not instrumented, so the thread sanitizer does not see that its fork and join order memory.
// These calls tell it, at the two places where we fork and join. Without the sanitizer they are empty.
#if defined(__SANITIZE_THREAD__)
extern "C" {
void __tsan_acquire(void* address);
void __tsan_release(void* address);
}
#endif

namespace strataflow {

/// One fork-join region, for the thread sanitizer.
class TsanJoin {
 public:
#if defined(__SANITIZE_THREAD__)
  void before_fork() { __tsan_release(&fork_); }
  void begin_task() { __tsan_acquire(&fork_); }
  void end_task() { __tsan_release(&join_); }
  void after_join() { __tsan_acquire(&join_); }

 private:
  char fork_ = 0;
  char join_ = 0;
#else
  void before_fork() {}
  void begin_task() {}
  void end_task() {}
  void after_join() {}
#endif
};

}  // namespace strataflow
