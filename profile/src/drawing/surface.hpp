// What a Drawing draws on: a page of Cairo, or the text of an SVG. Lengths, anchors and colours are as in drawing.hpp.
//
//   const std::unique_ptr<Surface> page = cairo_surface(Drawing::Format::kPdf, 842, 595, 1);
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "drawing/drawing.hpp"

namespace itin::profile {

class Surface {
 public:
  virtual ~Surface() = default;
  virtual void polyline(std::span<const Point2> points, const Stroke& stroke) = 0;
  virtual void polygon(std::span<const Point2> points, const Colour& fill) = 0;
  virtual void area(std::span<const std::vector<Point2>> rings, const Colour& fill) = 0;
  virtual void circle(Point2 centre, double radius, const Colour& fill) = 0;
  virtual void cells(const Box& box, CellCounts counts, std::span<const Rgba> colours) = 0;
  virtual void text(Point2 anchor, const std::string& text, const Lettering& lettering) = 0;
  virtual double text_width(const std::string& text, const Lettering& lettering) const = 0;
  virtual void clip(const Box& box) = 0;
  virtual void unclip() = 0;
  virtual void new_page() = 0;
  virtual std::string finish() = 0;
};

/// Makes a PDF, a PNG or pixels.
std::unique_ptr<Surface> cairo_surface(Drawing::Format format, double width, double height, double pixels_per_point);
/// Makes an SVG, or its elements alone.
std::unique_ptr<Surface> svg_surface(Drawing::Format format, double width, double height);

}  // namespace itin::profile
