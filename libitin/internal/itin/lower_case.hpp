// Text in lower case: words that people write as they like.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace itin {

/// Returns the text with its ASCII letters in lower case.
inline std::string in_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace itin
