// Writes an SVG that is small and can be searched: text is text, and lines have no points that nobody would miss.
#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/markup.hpp>
#include <itin/svg_path.hpp>

#include "drawing/surface.hpp"

namespace itin::profile {

namespace {

constexpr SvgPrecision kTenthOfAPixel{.tolerance = 0.07, .step = 0.01};  ///< a tenth of a screen's pixel; in points

std::string coordinate(double v) {
  return svg_number(v, kTenthOfAPixel.step);
}

std::string path_of(std::span<const Point2> points) {
  return svg_path(points, kTenthOfAPixel);
}

/// The attributes of a colour: `name` is "fill" or "stroke".
std::string painted(const char* name, const Colour& c) {
  const auto part = [](double v) { return static_cast<int>(std::lround(255 * v)); };
  std::string text = fmt::format(" {}=\"#{:02x}{:02x}{:02x}\"", name, part(c.red), part(c.green), part(c.blue));
  if (c.alpha < 1) text += fmt::format(" {}-opacity=\"{}\"", name, coordinate(c.alpha));
  return text;
}

class SvgSurface final : public Surface {
 public:
  SvgSurface(Drawing::Format format, double width, double height)
      : page_(cairo_surface(Drawing::Format::kPdf, 1, 1, 1)) {
    if (format == Drawing::Format::kSvgParts) return;
    end_ = "</svg>\n";
    svg_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}pt\" height=\"{1}pt\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"DejaVu Sans,Verdana,sans-serif\" stroke-linejoin=\"round\" xml:space=\"preserve\">\n",
        coordinate(width), coordinate(height));
  }

  void polyline(std::span<const Point2> points, const Stroke& stroke) override {
    svg_ += fmt::format("<path fill=\"none\"{} stroke-width=\"{}\"", painted("stroke", stroke.colour),
                        coordinate(stroke.width));
    if (!stroke.dashes.empty()) {
      svg_ += " stroke-dasharray=\"";
      for (const double length : stroke.dashes) svg_ += coordinate(length) + " ";
      svg_.back() = '"';
    }
    svg_ += fmt::format(" d=\"{}\"/>\n", path_of(points));
  }

  void polygon(std::span<const Point2> points, const Colour& fill) override {
    svg_ += fmt::format("<path{} d=\"{}z\"/>\n", painted("fill", fill), path_of(points));
  }

  void area(std::span<const std::vector<Point2>> rings, const Colour& fill) override {
    std::string path;
    for (const std::vector<Point2>& ring : rings) path += path_of(ring) + "z";
    svg_ += fmt::format("<path{} fill-rule=\"evenodd\" d=\"{}\"/>\n", painted("fill", fill), path);
  }

  void circle(Point2 centre, double radius, const Colour& fill) override {
    svg_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n", coordinate(centre.x), coordinate(centre.y),
                        coordinate(radius), painted("fill", fill));
  }

  void cells(const Box&, CellCounts, std::span<const Rgba>) override {
    throw Error("drawing failed: an SVG holds no cells");
  }

  /// The width of the text in a PDF; `textLength` gives it the same width in whatever font the reader has.
  double text_width(const std::string& text, const Lettering& lettering) const override {
    return page_->text_width(text, lettering);
  }

  void text(Point2 anchor, const std::string& text, const Lettering& lettering) override {
    if (text.empty()) return;
    const std::string x = coordinate(anchor.x), y = coordinate(anchor.y);
    svg_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}", x, y, coordinate(lettering.size),
                        painted("fill", lettering.colour));
    if (lettering.align != Align::kLeft)
      svg_ += fmt::format(" text-anchor=\"{}\"", lettering.align == Align::kCentre ? "middle" : "end");
    if (lettering.bold) svg_ += " font-weight=\"bold\"";
    if (lettering.rotation_deg != 0)
      svg_ += fmt::format(" transform=\"rotate({} {} {})\"", coordinate(-lettering.rotation_deg), x, y);
    if (lettering.rim > 0)
      svg_ += fmt::format("{} stroke-width=\"{}\" paint-order=\"stroke\"", painted("stroke", kRim),
                          coordinate(2 * lettering.rim));
    svg_ += fmt::format(" textLength=\"{}\" lengthAdjust=\"spacingAndGlyphs\">{}</text>\n",
                        coordinate(text_width(text, lettering)), escaped_markup(text));
  }

  void clip(const Box& box) override {
    ++clips_;
    svg_ += fmt::format(
        "<clipPath id=\"c{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/></clipPath>"
        "<g clip-path=\"url(#c{0})\">\n",
        clips_, coordinate(box.xmin), coordinate(box.ymin), coordinate(box.width()), coordinate(box.height()));
  }
  void unclip() override { svg_ += "</g>\n"; }

  void new_page() override { throw Error("drawing failed: an SVG has one page"); }

  std::string finish() override { return std::move(svg_) + end_; }

 private:
  std::unique_ptr<Surface> page_;  ///< text is measured on it
  int clips_ = 0;
  std::string svg_, end_;
};

}  // namespace

std::unique_ptr<Surface> svg_surface(Drawing::Format format, double width, double height) {
  return std::make_unique<SvgSurface>(format, width, height);
}

}  // namespace itin::profile
