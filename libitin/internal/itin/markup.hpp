// Text for XML and HTML documents.
#pragma once

#include <string>
#include <string_view>

namespace itin {

/// Writes entities for characters that would be markup, both in content and in attributes with double quotes.
std::string escaped_markup(std::string_view text);

}  // namespace itin
