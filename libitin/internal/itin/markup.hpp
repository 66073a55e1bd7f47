// Text for XML and HTML documents.
#pragma once

#include <string>
#include <string_view>

namespace itin {

/// Writes entities for characters that would be markup, both in content and in attributes with double quotes. The text
/// may have any bytes, and is written as printable_text().
std::string escaped_markup(std::string_view text);

}  // namespace itin
