// The numbers that a theme's features have in a field.
//
//   const auto metres = feature_numbers(store, theme, "crown_height");   // by the feature's number
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/store.hpp>

namespace itin {

/// Returns the field's values by feature, nothing where a feature has none or a text that is no number. Takes the
/// theme's number, from 1. The list is empty where the theme has no such field. Throws CorruptStore.
std::vector<std::optional<double>> feature_numbers(const Store& store, std::uint16_t theme, const std::string& field);

}  // namespace itin
