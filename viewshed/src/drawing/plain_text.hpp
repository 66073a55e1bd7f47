// Text that OpenImageIO 2.4 can draw: it takes UTF-8 but keeps only the last six bits of each letter beyond ASCII.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace itin::viewshed {

/// Latin letters lose their accents, a few signs are written out, anything else beyond ASCII becomes '?'.
std::string plain_text(std::string_view utf8);

/// A piece of a line of text. A raised piece, such as the two of square metres, is in smaller letters.
struct PlainPiece {
  std::string text;
  bool raised = false;

  friend bool operator==(const PlainPiece&, const PlainPiece&) = default;
};
std::vector<PlainPiece> plain_pieces(std::string_view utf8);

}  // namespace itin::viewshed
