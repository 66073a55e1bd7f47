// Line drawings as SVG, PDF or PNG.
//
//   Drawing drawing(Drawing::format_of("chart.pdf"), 800, 400);
//   drawing.polyline({{10, 10}, {100, 50}}, {kInk, 1.5});
//   drawing.text({100, 60}, "Caerphilly", {.size = 10, .align = Align::kCentre});
//   write(drawing.finish());
//
// Lengths are points, 1/72 inch, y downwards. The bytes depend on the calls alone.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/raster.hpp>
#include <profile/averaged_cells.hpp>

namespace itin::profile {

class Surface;

struct Colour {
  double red = 0, green = 0, blue = 0, alpha = 1;
};

struct Stroke {
  Colour colour;
  double width = 1;
  std::vector<double> dashes;  ///< lengths on, off, ...; empty: solid
};

enum class Align { kLeft, kCentre, kRight };

struct Lettering {
  double size = 9;
  Colour colour = {};
  Align align = Align::kLeft;
  bool bold = false;
  double rotation_deg = 0;  ///< counterclockwise about the anchor
  double rim = 0;           ///< width of a white edge that keeps what is below from the letters
};
inline constexpr Colour kRim{1, 1, 1, 0.85};

class Drawing {
 public:
  /// SVG parts are the elements that an SVG of another maker takes.
  enum class Format { kSvg, kSvgParts, kPdf, kPng, kPixels };
  /// The format for a file's name, by its ending in whatever case; nothing for another ending.
  static std::optional<Format> format_of(const std::string& path);

  /// `pixels_per_point` is the resolution of PNG and pixels.
  Drawing(Format format, double width, double height, double pixels_per_point = 2);
  ~Drawing();
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  double width() const { return width_; }
  double height() const { return height_; }

  void polyline(std::span<const Point2> points, const Stroke& stroke);
  void polygon(std::span<const Point2> points, const Colour& fill);
  /// Fills what rings enclose by the even-odd rule: a ring within another is a hole.
  void area(std::span<const std::vector<Point2>> rings, const Colour& fill);
  void rectangle(const Box& box, const Colour& fill);
  void outline(const Box& box, const Stroke& stroke);
  void circle(Point2 centre, double radius, const Colour& fill);
  /// Draws cells of equal size over a box, row by row from the top: unsmoothed, but averaged where they are smaller
  /// than the picture's pixels. Not for SVG.
  void cells(const Box& box, CellCounts counts, std::span<const Rgba> colours);
  /// Draws a text. The anchor is on the baseline, at the text's left end, centre or right end.
  void text(Point2 anchor, const std::string& text, const Lettering& lettering);
  double text_width(const std::string& text, const Lettering& lettering) const;
  /// The text cut to a width, with an ellipsis.
  std::string fitted(std::string text, double width, const Lettering& lettering) const;

  /// The text broken into lines of a width: at blanks, but for those between a number and its unit, and within words
  /// that are longer than a line.
  std::vector<std::string> lines(const std::string& text, double width, const Lettering& lettering) const;
  /// Returns this lettering, or one just small enough for the text to stand in `most` lines of a width without a broken
  /// word; 5 points at least.
  Lettering lettering_for(const std::string& text, double width, std::size_t most, Lettering lettering) const;

  /// Keeps everything from being drawn outside the box, until unclip().
  void clip(const Box& box);
  void unclip();
  /// Starts another page. Only for PDF.
  void new_page();

  /// Returns the file's bytes, or the pixels: red, green and blue of 8 bits, row by row from the top. Nothing can be
  /// drawn afterwards. Throws Error when Cairo fails.
  std::string finish();

 private:
  /// Returns where the characters of a word end that fit into the width, but at least the first.
  std::size_t end_within(const std::string& word, double width, const Lettering& lettering) const;

  double width_, height_;
  std::unique_ptr<Surface> surface_;
};

}  // namespace itin::profile
