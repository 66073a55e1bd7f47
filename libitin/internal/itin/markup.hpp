// Text for XML and HTML documents.
#pragma once

#include <string>
#include <string_view>

namespace itin {

/// With entities for what would be markup, in content as in attributes with double quotes.
std::string escaped_markup(std::string_view text);

}  // namespace itin
