#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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

}  // namespace strataflow
