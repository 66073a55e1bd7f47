// The only part that sees Cairo.
#include <algorithm>
#include <cairo-pdf.h>
#include <cairo.h>
#include <cmath>
#include <cstring>
#include <numbers>

#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/plain_text.hpp>

#include "drawing/surface.hpp"

namespace itin::profile {

namespace {

constexpr const char* kFont = "DejaVu Sans";
constexpr double kMostOfCairo = 32767;  ///< the longest side of an image

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

void require_success(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw Error(std::string("drawing failed: ") + cairo_status_to_string(status));
}

cairo_surface_t* make_page(Drawing::Format format, double width, double height, double pixels_per_point,
                           std::string* bytes) {
  if (format != Drawing::Format::kPdf)
    return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(width * pixels_per_point)),
                                      static_cast<int>(std::lround(height * pixels_per_point)));
  cairo_surface_t* pdf = cairo_pdf_surface_create_for_stream(append, bytes, width, height);
  // The date is fixed, so that the same input gives the same bytes.
  cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  return pdf;
}

/// Leaves letters as they are designed. Hinting fits them to pixels in a way that depends on what the process has drawn
/// before, so that equal pictures would have different bytes.
void forbid_hinting(cairo_t* cairo) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(cairo, options);
  cairo_font_options_destroy(options);
}

void select_font(cairo_t* cairo, const Lettering& lettering) {
  cairo_select_font_face(cairo, kFont, CAIRO_FONT_SLANT_NORMAL,
                         lettering.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, lettering.size);
}

void set_colour(cairo_t* cairo, const Colour& c) {
  cairo_set_source_rgba(cairo, c.red, c.green, c.blue, c.alpha);
}

/// Returns the colour as Cairo takes it: multiplied by its alpha.
std::uint32_t times_alpha(const Rgba& c) {
  const std::uint32_t alpha = c.alpha;
  const auto part = [&](std::uint32_t value) { return (value * alpha + 127) / 255; };
  return alpha << 24 | part(c.red) << 16 | part(c.green) << 8 | part(c.blue);
}

cairo_surface_t* image_of(std::span<const Rgba> colours, CellCounts counts) {
  cairo_surface_t* image =
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(counts.columns), static_cast<int>(counts.rows));
  require_success(cairo_surface_status(image));
  unsigned char* const data = cairo_image_surface_get_data(image);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(image));
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const std::uint32_t pixel = times_alpha(colours[i]);
    std::memcpy(data + i / counts.columns * stride + i % counts.columns * sizeof(pixel), &pixel, sizeof(pixel));
  }
  cairo_surface_mark_dirty(image);
  return image;
}

void trace(cairo_t* cairo, std::span<const Point2> points) {
  cairo_new_path(cairo);
  for (const Point2& p : points) cairo_line_to(cairo, p.x, p.y);
}

class CairoSurface final : public Surface {
 public:
  CairoSurface(Drawing::Format format, double width, double height, double pixels_per_point)
      : format_(format),
        page_(make_page(format, width, height, pixels_per_point, &bytes_)),
        cairo_(cairo_create(page_)) {
    if (format != Drawing::Format::kPdf) {
      cairo_set_source_rgb(cairo_, 1, 1, 1);
      cairo_paint(cairo_);
      cairo_scale(cairo_, pixels_per_point, pixels_per_point);
      forbid_hinting(cairo_);
    }
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
  }
  ~CairoSurface() override {
    cairo_destroy(cairo_);
    cairo_surface_destroy(page_);
  }
  CairoSurface(const CairoSurface&) = delete;
  CairoSurface& operator=(const CairoSurface&) = delete;

  void polyline(std::span<const Point2> points, const Stroke& stroke) override {
    trace(cairo_, points);
    set_colour(cairo_, stroke.colour);
    cairo_set_line_width(cairo_, stroke.width);
    cairo_set_dash(cairo_, stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0);
    cairo_stroke(cairo_);
  }

  void polygon(std::span<const Point2> points, const Colour& fill) override {
    trace(cairo_, points);
    set_colour(cairo_, fill);
    cairo_fill(cairo_);
  }

  void area(std::span<const std::vector<Point2>> rings, const Colour& fill) override {
    cairo_new_path(cairo_);
    for (const std::vector<Point2>& ring : rings) {
      for (const Point2& p : ring) cairo_line_to(cairo_, p.x, p.y);
      cairo_close_path(cairo_);
      cairo_new_sub_path(cairo_);
    }
    set_colour(cairo_, fill);
    cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
    cairo_fill(cairo_);
    cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_WINDING);
  }

  void circle(Point2 centre, double radius, const Colour& fill) override {
    cairo_new_path(cairo_);
    cairo_arc(cairo_, centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
    set_colour(cairo_, fill);
    cairo_fill(cairo_);
  }

  void cells(const Box& box, CellCounts counts, std::span<const Rgba> colours) override {
    const CellCounts drawn = fewest(box, counts);
    cairo_surface_t* image =
        drawn == counts ? image_of(colours, counts) : image_of(averaged_cells(colours, counts, drawn), drawn);
    const auto columns = static_cast<double>(drawn.columns), rows = static_cast<double>(drawn.rows);
    cairo_save(cairo_);
    cairo_translate(cairo_, box.xmin, box.ymin);
    cairo_scale(cairo_, box.width() / columns, box.height() / rows);
    cairo_set_source_surface(cairo_, image, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(cairo_), CAIRO_FILTER_NEAREST);
    cairo_rectangle(cairo_, 0, 0, columns, rows);
    cairo_fill(cairo_);
    cairo_restore(cairo_);
    cairo_surface_destroy(image);
  }

  double text_width(const std::string& text, const Lettering& lettering) const override {
    select_font(cairo_, lettering);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, printable_text(text).c_str(), &extents);
    return extents.x_advance;
  }

  void text(Point2 anchor, const std::string& any_text, const Lettering& lettering) override {
    const std::string text = printable_text(any_text);
    double shift = 0;
    if (lettering.align != Align::kLeft) {
      shift = -text_width(text, lettering) / (lettering.align == Align::kCentre ? 2 : 1);
    }
    cairo_save(cairo_);
    select_font(cairo_, lettering);
    set_colour(cairo_, lettering.colour);
    cairo_translate(cairo_, anchor.x, anchor.y);
    cairo_rotate(cairo_, in_radians(-lettering.rotation_deg));
    cairo_move_to(cairo_, shift, 0);
    if (lettering.rim > 0) {
      cairo_text_path(cairo_, text.c_str());
      set_colour(cairo_, kRim);
      cairo_set_line_width(cairo_, 2 * lettering.rim);
      cairo_set_dash(cairo_, nullptr, 0, 0);
      cairo_stroke(cairo_);
      set_colour(cairo_, lettering.colour);
      cairo_move_to(cairo_, shift, 0);
    }
    cairo_show_text(cairo_, text.c_str());
    cairo_restore(cairo_);
  }

  void clip(const Box& box) override {
    cairo_save(cairo_);
    cairo_rectangle(cairo_, box.xmin, box.ymin, box.width(), box.height());
    cairo_clip(cairo_);
  }
  void unclip() override { cairo_restore(cairo_); }
  void new_page() override { cairo_show_page(cairo_); }

  std::string finish() override {
    if (format_ == Drawing::Format::kPng) {
      cairo_surface_flush(page_);
      require_success(cairo_surface_write_to_png_stream(page_, append, &bytes_));
    }
    if (format_ == Drawing::Format::kPixels) append_pixels();
    cairo_surface_finish(page_);
    require_success(cairo_status(cairo_));
    require_success(cairo_surface_status(page_));
    return std::move(bytes_);
  }

 private:
  /// Returns how many cells tell as much as these: no more than a picture has pixels there, or than Cairo takes.
  CellCounts fewest(const Box& box, CellCounts counts) const {
    double width = kMostOfCairo, height = kMostOfCairo;
    if (format_ != Drawing::Format::kPdf) {
      width = box.width(), height = box.height();
      cairo_user_to_device_distance(cairo_, &width, &height);
    }
    const auto most = [](double length) {
      return static_cast<std::size_t>(std::clamp(std::ceil(length), 1.0, kMostOfCairo));
    };
    return {std::min(counts.columns, most(width)), std::min(counts.rows, most(height))};
  }

  void append_pixels() {
    require_success(cairo_surface_status(page_));
    cairo_surface_flush(page_);
    const int width = cairo_image_surface_get_width(page_), height = cairo_image_surface_get_height(page_);
    const unsigned char* row = cairo_image_surface_get_data(page_);
    bytes_.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y, row += cairo_image_surface_get_stride(page_)) {
      for (int x = 0; x < width; ++x) {
        std::uint32_t pixel = 0;
        std::memcpy(&pixel, row + sizeof(pixel) * static_cast<std::size_t>(x), sizeof(pixel));
        for (const unsigned shift : {16U, 8U, 0U}) bytes_ += static_cast<char>(pixel >> shift & 0xff);
      }
    }
  }

  Drawing::Format format_;
  std::string bytes_;
  cairo_surface_t* page_;
  cairo_t* cairo_;
};

}  // namespace

std::unique_ptr<Surface> cairo_surface(Drawing::Format format, double width, double height, double pixels_per_point) {
  return std::make_unique<CairoSurface>(format, width, height, pixels_per_point);
}

}  // namespace itin::profile
