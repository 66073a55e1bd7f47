// Lines of text tables: commas, semicolons or tabs between the cells, quotes about them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace itin::profile {

/// A semicolon or a tab where the line has one outside quotes, else a comma.
char separator_of(std::string_view line);

/// Without their quotes, blanks at the ends and the line's end.
std::vector<std::string> cells_of(std::string_view line, char separator);

/// A number with nothing behind it, "nan" and "inf" included. Where commas do not separate, one may stand for the
/// decimal point.
std::optional<double> number_in(std::string_view cell, char separator);

}  // namespace itin::profile
