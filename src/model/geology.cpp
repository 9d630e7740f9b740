#include "model/geology.h"

#include <algorithm>
#include <array>
#include <utility>

namespace strataflow {

namespace {
constexpr std::array<std::pair<Role, std::string_view>, 11> words_of_roles{{{Role::unknown, "unknown"},
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

/// Roles of surfaces in the order in which they cut each other off.
int cutting_rank(Role role) {
  switch (role) {
    case Role::boundary:
      return 4;
    case Role::fault:
      return 3;
    case Role::intrusion:
      return 2;
    case Role::horizon:
    case Role::unconformity:
      return 1;
    default:
      return 0;
  }
}
}  // namespace

std::string_view to_string(Role role) {
  for (const auto& [candidate, word] : words_of_roles)
    if (candidate == role) return word;
  return "unknown";
}

std::vector<std::string_view> role_words() {
  std::vector<std::string_view> words;
  for (const auto& [role, word] : words_of_roles)
    if (role != Role::unknown) words.push_back(word);
  return words;
}

std::optional<Role> role_from(std::string_view word) {
  for (const auto& [role, candidate] : words_of_roles)
    if (candidate == word) return role;
  return std::nullopt;
}

std::uint32_t youngest_of(const std::vector<Entity>& all, const std::vector<std::uint32_t>& entities) {
  return *std::max_element(entities.begin(), entities.end(), [&](std::uint32_t a, std::uint32_t b) {
    const int rank_a = cutting_rank(all[a].role), rank_b = cutting_rank(all[b].role);
    return rank_a != rank_b ? rank_a < rank_b : a < b;
  });
}

}  // namespace strataflow
