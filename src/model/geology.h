#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strataflow {

/// What a geological feature is. The words are those of the job file.
enum class Role : std::uint8_t {
  unknown,
  fault,
  horizon,
  unconformity,
  boundary,
  intrusion,
  well,
  points,
  outline,
  hole,
  curve
};

std::string_view to_string(Role role);
/// The words a job file may say: every role but unknown.
std::vector<std::string_view> role_words();
/// The role of that name, or nothing.
std::optional<Role> role_from(std::string_view word);

/// A geological feature: one horizon, fault, boundary …; it may own many surfaces.
struct Entity {
  std::string name;
  Role role = Role::unknown;
  template <class A>
  void archive(A& a) {
    a(name, role);
  }
};

/// Which of several coinciding entities is the youngest: the one whose role cuts the others off (boundary, then fault,
/// then intrusion, then horizon and unconformity, then any other), and of these the last in input order. Inputs say no
/// ages; where they list horizons, the deposited-last one comes last. `entities` holds at least one index.
std::uint32_t youngest_of(const std::vector<Entity>& all, const std::vector<std::uint32_t>& entities);

}  // namespace strataflow
