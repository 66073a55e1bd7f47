// Text that every format can hold: UTF-8 without control characters.
//
//   PlainTexts texts("masts.csv");
//   site.name = texts.plain(cell, "line 7");
//   for (const std::string& warning : texts.warnings()) ...   // tells what was not plain
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace itin {

/// Tells whether a text is UTF-8.
bool is_utf8(std::string_view text);

/// Tells whether a text is UTF-8 without control characters, tabs and line breaks included.
bool is_plain_text(std::string_view text);

/// Returns the text as it is if is_plain_text(). Else bytes that are not UTF-8 are read as Windows-1252 (of which
/// Latin-1 is a part), tabs and line breaks become blanks, and other control characters become question marks.
std::string plain_text(std::string_view text);

/// Does the same, but keeps tabs and line breaks: the text as any document may hold it, whatever it was made of.
std::string printable_text(std::string_view text);

/// Returns the text without the blanks, tabs and carriage returns at its ends.
std::string without_outer_blanks(const std::string& text);

/// Makes the texts of one file plain, and remembers which were not.
class PlainTexts {
 public:
  explicit PlainTexts(std::string path) : path_(std::move(path)) {}
  /// Returns plain_text(). `place` tells where in the file the text stands: "line 7", "feature 3".
  std::string plain(std::string_view text, std::string_view place);
  /// Tells of texts that were not UTF-8, and of control characters: a line each, which names the first place.
  std::vector<std::string> warnings() const;

 private:
  struct Finding {
    std::string first;  ///< the first place; empty where there is none
    std::uint64_t more = 0;
    void add(std::string_view place);
  };
  std::string described(const Finding& finding, const char* what) const;

  std::string path_;
  Finding not_utf8_, control_;
};

}  // namespace itin
