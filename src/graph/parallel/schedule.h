#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace strataflow {

/// How the parallel loops of the process run while a ScheduleScope lives.
enum class ScheduleKind : std::uint8_t {
  serial,    ///< chunks one after the other, in order
  threads,   ///< chunks as oneTBB tasks
  shuffled   ///< chunks one after the other, in a random order: finds code that leans on the order
};

/// Sets the schedule for its lifetime; an executor makes one per run. Not to be nested.
class ScheduleScope {
 public:
  ScheduleScope(ScheduleKind kind, std::uint64_t shuffle_seed = 0);
  ~ScheduleScope();
  ScheduleScope(const ScheduleScope&) = delete;
  ScheduleScope& operator=(const ScheduleScope&) = delete;
};

/// A borrowed callable: a pointer to the object and how to call it. Lives as long as the call it is passed to.
class ChunkBody {
 public:
  template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, ChunkBody>)
  ChunkBody(F& body) : object_(&body), call_([](void* object, std::size_t chunk) { (*static_cast<F*>(object))(chunk); }) {}
  void operator()(std::size_t chunk) const { call_(object_, chunk); }

 private:
  void* object_;
  void (*call_)(void*, std::size_t);
};

/// Calls body(0) … body(chunk_count − 1), each once, possibly at the same time. If any throw, the exception of the
/// lowest chunk is thrown on, whatever the schedule. Everything with threads in strataflow goes through here or
/// through the executors.
void run_chunks(std::size_t chunk_count, ChunkBody body);

}  // namespace strataflow
