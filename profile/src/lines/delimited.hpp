// Reads lines of text tables: commas, semicolons or tabs between the cells, quotes about them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace itin::profile {

/// The separator of a line: a semicolon or a tab where the line has one outside quotes, else a comma.
char separator_of(std::string_view line);

/// Returns the cells without their quotes, blanks at the ends and the line's end.
std::vector<std::string> cells_of(std::string_view line, char separator);

/// Reads a number with nothing behind it, "nan" and "inf" included. Where commas do not separate, one may be the
/// decimal sign.
std::optional<double> number_in(std::string_view cell, char separator);

}  // namespace itin::profile
