// Numbers of tables that are written with a decimal comma.
#pragma once

#include <string>
#include <string_view>

namespace itin {

/// Tells whether a comma in a number may be meant to separate thousands, as in 318,000.
bool may_part_thousands(std::string_view number);

/// Returns the number with a point in place of its comma, where it has one comma that can only be a decimal one; else
/// the text unchanged.
std::string with_decimal_point(std::string text);

}  // namespace itin
