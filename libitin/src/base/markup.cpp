#include <itin/markup.hpp>
#include <itin/plain_text.hpp>

namespace itin {

std::string escaped_markup(std::string_view text) {
  std::string result;
  for (const char c : printable_text(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace itin
