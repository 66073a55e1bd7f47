// Text on pictures, with a font found on the machine.
#pragma once

#include <string>

#include "drawing/canvas.hpp"
#include "drawing/plain_text.hpp"

namespace itin::viewshed {

enum class Align { kLeft, kCentre, kRight };

class Lettering {
 public:
  /// Looks for a sans-serif font in the usual places. Without one nothing is drawn and widths are 0.
  Lettering();
  bool available() const { return !font_.empty(); }

  /// `baseline` is where the text stands; `size` is the font's height in pixels.
  void draw(Canvas& canvas, const std::string& text, Point2 baseline, int size, Rgba colour,
            Align align = Align::kLeft) const;
  /// Draws the text with a white rim, so that it can be read over anything.
  void draw_with_rim(Canvas& canvas, const std::string& text, Point2 baseline, int size, Rgba colour) const;
  int width(const std::string& text, int size) const;

 private:
  int advance(const PlainPiece& piece, int size) const;

  std::string font_;  ///< path
};

}  // namespace itin::viewshed
