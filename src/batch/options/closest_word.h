#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace strataflow {

/// The candidate fewest edits away from `word` (the first of equals), or "" when none is near enough to be meant.
std::string_view closest_word(std::string_view word, const std::vector<std::string_view>& candidates);

/// "did you mean 'sites'?" or, when nothing is near, "known: sites, target_edge_length_m".
std::string suggestion(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace strataflow
