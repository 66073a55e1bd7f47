// Finds the name that a misspelt one was meant to be.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace itin {

/// Returns the name that is nearest to `given` in letters left out, added, exchanged or swapped with their neighbour,
/// or that `given` begins; nothing where none is near. Among several it is the first. O(length^2) per name.
std::optional<std::string> likely_meant(std::string_view given, const std::vector<std::string>& names);

/// Returns "; did you mean NAME?", or an empty text.
std::string did_you_mean(std::string_view given, const std::vector<std::string>& names);

}  // namespace itin
