#include "model/geology.h"

#include <array>
#include <utility>

namespace strataflow {

namespace {
constexpr std::array<std::pair<Role, std::string_view>, 11> role_words{{{Role::unknown, "unknown"},
                                                                        {Role::fault, "fault"},
                                                                        {Role::horizon, "horizon"},
                                                                        {Role::unconformity, "unconformity"},
                                                                        {Role::boundary, "boundary"},
                                                                        {Role::intrusion, "intrusion"},
                                                                        {Role::well, "well"},
                                                                        {Role::points, "points"},
                                                                        {Role::outline, "outline"},
                                                                        {Role::hole, "hole"},
                                                                        {Role::curve, "curve"}}};
}

std::string_view to_string(Role role) {
  for (const auto& [candidate, word] : role_words)
    if (candidate == role) return word;
  return "unknown";
}

std::optional<Role> role_from(std::string_view word) {
  for (const auto& [role, candidate] : role_words)
    if (candidate == word) return role;
  return std::nullopt;
}

}  // namespace strataflow
