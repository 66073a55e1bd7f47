// Numbers of tables that are written with a decimal comma.
#pragma once

#include <string>
#include <string_view>

namespace itin {

/// Whether a comma in a number may be meant to part thousands, as in 318,000.
bool may_part_thousands(std::string_view number);

/// The number with a point in place of its comma, where it has one comma that can only be a decimal one; else the text
/// as it is.
std::string with_decimal_point(std::string text);

}  // namespace itin
