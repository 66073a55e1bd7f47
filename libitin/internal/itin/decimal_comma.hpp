// Numbers of tables that are written with a decimal comma.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace itin {

/// Tells whether a comma in a number may be meant to separate thousands: in 318,000, but not in 0,125 or 318000,125.
bool may_part_thousands(std::string_view number);

/// Returns the number with a point in place of its comma, where it has one comma that can only be a decimal one; else
/// the text unchanged.
std::string with_decimal_point(std::string text);

/// Reads a number that is the whole text, "nan" and "inf" included, with a decimal point, or with a comma that can only
/// be a decimal one; whatever the locale.
std::optional<double> number_in(std::string_view text);

}  // namespace itin
