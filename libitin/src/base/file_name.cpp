#include <itin/file_name.hpp>

namespace itin {

std::string file_name(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
                       c == '.' || (c & 0x80) != 0;
    text += plain ? c : '_';
  }
  return text.empty() || text[0] == '.' ? "_" + text : text;
}

}  // namespace itin
