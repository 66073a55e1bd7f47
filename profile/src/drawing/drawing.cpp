#include "drawing/drawing.hpp"

#include <algorithm>
#include <array>
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>
#include <string_view>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>

namespace itin::profile {

namespace {

constexpr const char* kFont = "DejaVu Sans";

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

void require_success(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw Error(std::string("drawing failed: ") + cairo_status_to_string(status));
}

cairo_surface_t* make_surface(Drawing::Format format, double width, double height, double pixels_per_point,
                              std::string* bytes) {
  switch (format) {
    case Drawing::Format::kSvg: {
      cairo_surface_t* svg = cairo_svg_surface_create_for_stream(append, bytes, width, height);
      cairo_svg_surface_set_document_unit(svg, CAIRO_SVG_UNIT_PT);
      return svg;
    }
    case Drawing::Format::kPdf: {
      cairo_surface_t* pdf = cairo_pdf_surface_create_for_stream(append, bytes, width, height);
      // A fixed date: the same input gives the same bytes.
      cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
      return pdf;
    }
    case Drawing::Format::kPng:
      break;
  }
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(width * pixels_per_point)),
                                    static_cast<int>(std::lround(height * pixels_per_point)));
}

/// Cairo numbers the surfaces of a process, and an SVG's only group bears the number though nothing refers to it.
void remove_surface_number(std::string& svg) {
  constexpr std::string_view kNumbered = "<g id=\"surface";
  const std::size_t group = svg.find(kNumbered), end = svg.find("\">", group);
  if (group != std::string::npos) svg.erase(group + 2, end + 1 - (group + 2));
}

void select_font(cairo_t* cairo, const Lettering& lettering) {
  cairo_select_font_face(cairo, kFont, CAIRO_FONT_SLANT_NORMAL,
                         lettering.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, lettering.size);
}

void set_colour(cairo_t* cairo, const Colour& c) {
  cairo_set_source_rgba(cairo, c.red, c.green, c.blue, c.alpha);
}

/// As Cairo wants it: colours times their alpha.
std::uint32_t times_alpha(std::uint32_t argb) {
  const std::uint32_t alpha = argb >> 24;
  const auto part = [&](unsigned shift) { return ((argb >> shift & 0xff) * alpha + 127) / 255 << shift; };
  return alpha << 24 | part(16) | part(8) | part(0);
}

void trace(cairo_t* cairo, std::span<const Point2> points) {
  cairo_new_path(cairo);
  for (const Point2& p : points) cairo_line_to(cairo, p.x, p.y);
}

}  // namespace

struct Drawing::Surface {
  Surface(Format f, double width, double height, double pixels_per_point)
      : format(f), surface(make_surface(f, width, height, pixels_per_point, &bytes)), cairo(cairo_create(surface)) {
    if (f == Format::kPng) {
      cairo_set_source_rgb(cairo, 1, 1, 1);
      cairo_paint(cairo);
      cairo_scale(cairo, pixels_per_point, pixels_per_point);
    }
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  }
  ~Surface() {
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
  }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  Format format;
  std::string bytes;
  cairo_surface_t* surface;
  cairo_t* cairo;
};

std::optional<Drawing::Format> Drawing::format_of(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".svg") return Format::kSvg;
  if (ending == ".pdf") return Format::kPdf;
  if (ending == ".png") return Format::kPng;
  return std::nullopt;
}

Drawing::Drawing(Format format, double width, double height, double pixels_per_point)
    : width_(width), height_(height), surface_(std::make_unique<Surface>(format, width, height, pixels_per_point)) {
  require_success(cairo_status(surface_->cairo));
}
Drawing::~Drawing() = default;

void Drawing::polyline(std::span<const Point2> points, const Stroke& stroke) {
  cairo_t* cairo = surface_->cairo;
  trace(cairo, points);
  set_colour(cairo, stroke.colour);
  cairo_set_line_width(cairo, stroke.width);
  cairo_set_dash(cairo, stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0);
  cairo_stroke(cairo);
}

void Drawing::polygon(std::span<const Point2> points, const Colour& fill) {
  trace(surface_->cairo, points);
  set_colour(surface_->cairo, fill);
  cairo_fill(surface_->cairo);
}

void Drawing::rectangle(const Box& box, const Colour& fill) {
  const Point2 corners[] = {{box.xmin, box.ymin}, {box.xmax, box.ymin}, {box.xmax, box.ymax}, {box.xmin, box.ymax}};
  polygon(corners, fill);
}

void Drawing::outline(const Box& box, const Stroke& stroke) {
  polyline(std::array{Point2{box.xmin, box.ymin}, Point2{box.xmax, box.ymin}, Point2{box.xmax, box.ymax},
                      Point2{box.xmin, box.ymax}, Point2{box.xmin, box.ymin}},
           stroke);
}

void Drawing::circle(Point2 centre, double radius, const Colour& fill) {
  cairo_new_path(surface_->cairo);
  cairo_arc(surface_->cairo, centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
  set_colour(surface_->cairo, fill);
  cairo_fill(surface_->cairo);
}

void Drawing::cells(const Box& box, int columns, int rows, std::span<const std::uint32_t> argb) {
  cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, columns, rows);
  unsigned char* const data = cairo_image_surface_get_data(image);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(image));
  const auto width = static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < argb.size(); ++i) {
    const std::uint32_t pixel = times_alpha(argb[i]);
    std::memcpy(data + i / width * stride + i % width * sizeof(pixel), &pixel, sizeof(pixel));
  }
  cairo_surface_mark_dirty(image);
  cairo_t* cairo = surface_->cairo;
  cairo_save(cairo);
  cairo_translate(cairo, box.xmin, box.ymin);
  cairo_scale(cairo, box.width() / columns, box.height() / rows);
  cairo_set_source_surface(cairo, image, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_NEAREST);
  cairo_rectangle(cairo, 0, 0, columns, rows);
  cairo_fill(cairo);
  cairo_restore(cairo);
  cairo_surface_destroy(image);
}

double Drawing::text_width(const std::string& text, const Lettering& lettering) const {
  select_font(surface_->cairo, lettering);
  cairo_text_extents_t extents;
  cairo_text_extents(surface_->cairo, text.c_str(), &extents);
  return extents.x_advance;
}

std::string Drawing::fitted(std::string text, double width, const Lettering& lettering) const {
  if (text_width(text, lettering) <= width) return text;
  const std::string dots = "\xE2\x80\xA6";
  while (!text.empty() && text_width(text + dots, lettering) > width) {
    // Whole characters of UTF-8.
    while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
    text.pop_back();
  }
  return text + dots;
}

void Drawing::text(Point2 anchor, const std::string& text, const Lettering& lettering) {
  cairo_t* cairo = surface_->cairo;
  double shift = 0;
  if (lettering.align != Align::kLeft) {
    shift = -text_width(text, lettering) / (lettering.align == Align::kCentre ? 2 : 1);
  }
  cairo_save(cairo);
  select_font(cairo, lettering);
  set_colour(cairo, lettering.colour);
  cairo_translate(cairo, anchor.x, anchor.y);
  cairo_rotate(cairo, -lettering.turn_deg * std::numbers::pi / 180);
  cairo_move_to(cairo, shift, 0);
  if (lettering.rim > 0) {
    cairo_text_path(cairo, text.c_str());
    cairo_set_source_rgba(cairo, 1, 1, 1, 0.85);
    cairo_set_line_width(cairo, 2 * lettering.rim);
    cairo_set_dash(cairo, nullptr, 0, 0);
    cairo_stroke(cairo);
    set_colour(cairo, lettering.colour);
    cairo_move_to(cairo, shift, 0);
  }
  cairo_show_text(cairo, text.c_str());
  cairo_restore(cairo);
}

std::vector<std::string> Drawing::lines(const std::string& text, double width, const Lettering& lettering) const {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || text_width(longer, lettering) <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

void Drawing::clip(const Box& box) {
  cairo_save(surface_->cairo);
  cairo_rectangle(surface_->cairo, box.xmin, box.ymin, box.width(), box.height());
  cairo_clip(surface_->cairo);
}

void Drawing::unclip() {
  cairo_restore(surface_->cairo);
}

void Drawing::new_page() {
  cairo_show_page(surface_->cairo);
}

std::string Drawing::finish() {
  if (surface_->format == Format::kPng) {
    cairo_surface_flush(surface_->surface);
    require_success(cairo_surface_write_to_png_stream(surface_->surface, append, &surface_->bytes));
  }
  cairo_surface_finish(surface_->surface);
  require_success(cairo_status(surface_->cairo));
  require_success(cairo_surface_status(surface_->surface));
  if (surface_->format == Format::kSvg) remove_surface_number(surface_->bytes);
  return std::move(surface_->bytes);
}

}  // namespace itin::profile
