// The name that somebody meant who misspelt one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace itin::cli {

/// The name that is nearest to `given` in letters left out, added, exchanged or swapped with their neighbour, or that
/// `given` begins; nothing where none is near. The first of several. O(length^2) per name.
std::optional<std::string> likely_meant(std::string_view given, const std::vector<std::string>& names);

/// "; did you mean NAME?", or nothing.
std::string did_you_mean(std::string_view given, const std::vector<std::string>& names);

}  // namespace itin::cli
