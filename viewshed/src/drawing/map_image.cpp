#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/label_places.hpp>
#include <itin/parallel.hpp>
#include <itin/round_length.hpp>
#include <itin/void_stripes.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/surface.hpp>

#include "bounds/pixel_heights.hpp"
#include "drawing/canvas.hpp"
#include "drawing/hillshade.hpp"
#include "drawing/lettering.hpp"
#include "drawing/map_overlay.hpp"

namespace itin::viewshed {

namespace {

constexpr Rgba kMark{213, 94, 0};
constexpr Rgba kInk{30, 30, 30};
constexpr Rgba kFaint{95, 95, 95};
constexpr Rgba kMapPaper{255, 255, 255};
constexpr Rgba kUnread{244, 244, 244};  ///< beyond what was looked at, and so what was read

constexpr std::uint8_t kLevelGrey = 214;  ///< the grey of level ground

constexpr double kOutsideFade = 0.6;  ///< how far ground outside the field of view fades into the paper

std::string length_text(double metres) {
  return metres >= 1000 ? fmt::format("{:.10g} km", metres / 1000) : fmt::format("{:.10g} m", metres);
}

void require_possible(const MapOptions& options) {
  if (options.map_pixels < 200 || options.map_pixels > 16000)
    throw InputError(fmt::format("map of {} pixels: give 200 to 16000", options.map_pixels), "map_pixels");
}

class MapDrawing {
 public:
  /// heights_of(pixels) returns the heights of the ground.
  template <class HeightsOf>
  MapDrawing(const HeightsOf& heights_of, const Result& result, const MapOptions& options)
      : result_(result),
        options_(options),
        pixels_(pixel_grid(result.grid, options.map_pixels)),
        shades_(hillshade(heights_of(pixels_), pixels_)),
        width_(static_cast<int>(pixels_.columns())),
        height_(static_cast<int>(pixels_.rows())),
        unit_(std::max(10, static_cast<int>(std::lround(std::max(width_, height_) / 80.0)))),
        overlay_(result, options),
        has_void_(std::find(options.no_data.begin(), options.no_data.end(), 1) != options.no_data.end()),
        has_outside_(shows_outside()),
        canvas_(std::max(width_, 40 * unit_) + 4 * unit_,
                height_ + 14 * unit_ + further_rows() * key_height() +
                    static_cast<int>(source_lines().size()) * source_height(),
                kMapPaper),
        left_((canvas_.width() - width_) / 2),
        top_(6 * unit_) {}

  MapImage draw() {
    draw_ground();
    draw_observers();
    canvas_.frame(left_ - 1, top_ - 1, width_ + 2, height_ + 2, kInk);
    draw_heading();
    draw_north_arrow();
    draw_scale_bar();
    draw_legend();
    MapImage image{canvas_.width(), canvas_.height(), std::move(canvas_.rgb()), {}};
    if (!letters_.available())
      image.warnings.emplace_back("map: no font found, drawn without text; install fonts-dejavu-core");
    return image;
  }

 private:
  static RasterGrid pixel_grid(const RasterGrid& cells, int longest) {
    const Box box = cells.bounds();
    const double pixel = std::max(box.width(), box.height()) / longest;
    const auto count = [&](double length) { return std::max<std::int64_t>(1, std::llround(length / pixel)); };
    const std::int64_t columns = count(box.width()), rows = count(box.height());
    return {{box.xmin, box.ymax},
            box.width() / static_cast<double>(columns),
            box.height() / static_cast<double>(rows),
            columns,
            rows};
  }

  std::optional<std::size_t> cell_of(std::int64_t column, std::int64_t row) const {
    const auto cell = result_.grid.cell_at(pixels_.centre(column, row));
    return cell ? std::optional(result_.grid.index(*cell)) : std::nullopt;
  }
  bool lacks_ground(std::optional<std::size_t> cell) const {
    return cell && *cell < options_.no_data.size() && options_.no_data[*cell] == 1;
  }
  /// Tells whether the middle of some pixel shows what is outside the field of view.
  bool shows_outside() const {
    for (std::int64_t y = 0; y < pixels_.rows(); ++y)
      for (std::int64_t x = 0; x < pixels_.columns(); ++x)
        if (const auto cell = cell_of(x, y); !lacks_ground(cell) && !(cell && overlay_.at(*cell))) return true;
    return false;
  }

  int key_height() const { return 7 * unit_ / 4; }

  /// Lines about sources, and one that counts the rest.
  std::vector<std::string> source_lines() const {
    constexpr std::size_t kMost = 6;
    std::vector<std::string> lines = options_.sources;
    if (lines.size() > kMost) {
      lines.resize(kMost - 1);
      lines.push_back(fmt::format("and {} more sorts of sources", options_.sources.size() - lines.size()));
    }
    if (!lines.empty()) lines.front() = "Ground: " + lines.front();
    return lines;
  }
  int source_height() const { return 5 * unit_ / 4; }

  /// Rows of the legend beyond the three that there is always room for.
  int further_rows() const {
    return std::max(0, static_cast<int>(overlay_.keys().size()) + (has_outside_ ? 1 : 0) + (has_void_ ? 1 : 0) +
                           (options_.beyond_text.empty() ? 0 : 1) - 3);
  }

  /// The mean of what a pixel's samples show.
  struct Shown {
    double red = 0, green = 0, blue = 0;  ///< times the opacity
    double opacity = 0;
    double outside = 0;  ///< share outside the field of view

    void add(const std::optional<Tint>& tint) {
      outside += tint ? 0 : 1;
      if (!tint) return;
      opacity += tint->opacity;
      red += tint->opacity * tint->colour.red;
      green += tint->opacity * tint->colour.green;
      blue += tint->opacity * tint->colour.blue;
    }
    Rgba colour() const {
      const auto channel = [&](double sum) { return static_cast<std::uint8_t>(std::lround(sum / opacity)); };
      return opacity > 0 ? Rgba{channel(red), channel(green), channel(blue)} : Rgba{};
    }
  };

  Shown shown_at(std::int64_t column, std::int64_t row) const {
    // There are as many samples as cells along a pixel's side, within reason, so that thin shadows are not lost.
    const double cells = pixels_.cell_width() / result_.grid.cell_width();
    const int samples = static_cast<int>(std::clamp(std::ceil(cells), 1.0, 4.0));
    Shown shown;
    for (int i = 0; i < samples; ++i) {
      for (int j = 0; j < samples; ++j) {
        const Point2 centre = pixels_.centre(column, row);
        const auto cell = result_.grid.cell_at({centre.x + ((i + 0.5) / samples - 0.5) * pixels_.cell_width(),
                                                centre.y + ((j + 0.5) / samples - 0.5) * pixels_.cell_height()});
        shown.add(cell ? overlay_.at(result_.grid.index(*cell)) : std::nullopt);
      }
    }
    const int count = samples * samples;
    return {shown.red / count, shown.green / count, shown.blue / count, shown.opacity / count, shown.outside / count};
  }

  void draw_ground() {
    parallel_for(static_cast<std::size_t>(height_), [&](std::size_t row) {
      for (int x = 0; x < width_; ++x) draw_ground_at(x, static_cast<int>(row));
    });
  }

  void draw_ground_at(int x, int y) {
    const float shade = shades_[pixels_.index({x, y})];
    const int px = left_ + x, py = top_ + y;
    if (lacks_ground(cell_of(x, y))) return draw_void(px, py);
    if (std::isnan(shade)) return canvas_.blend(px, py, kUnread, 1);
    const auto grey = static_cast<std::uint8_t>(std::clamp(kLevelGrey + 150.0 * (shade - kLevelShade), 100.0, 250.0));
    const Shown shown = shown_at(x, y);
    canvas_.blend(px, py, {grey, grey, grey}, 1);
    canvas_.blend(px, py, kMapPaper, kOutsideFade * shown.outside);
    canvas_.blend(px, py, shown.colour(), shown.opacity);
  }

  void draw_void(int x, int y) { canvas_.blend(x, y, void_colour(x, y, unit_), 1); }

  Point2 place_of(Point2 p) const { return {left_ + pixels_.column_at(p.x), top_ + pixels_.row_at(p.y)}; }

  void draw_mark(Point2 at) {
    canvas_.fill_disc(at, 0.62 * unit_, kMapPaper);
    canvas_.fill_disc(at, 0.5 * unit_, kInk);
    canvas_.fill_disc(at, 0.4 * unit_, kMark);
  }

  void draw_observers() {
    for (const Observer& observer : result_.request.observers)
      if (result_.grid.cell_at(observer.position)) draw_mark(place_of(observer.position));
    std::vector<const Observer*> named;
    for (const Observer& observer : result_.request.observers)
      if (!observer.name.empty() && result_.grid.cell_at(observer.position)) named.push_back(&observer);
    const std::size_t labels = draw_names(named);
    if (labels < named.size()) names_left_out_ = left_out_text(named.size() - labels, named.size());
  }

  /// Draws the names that have room, and returns their number.
  std::size_t draw_names(const std::vector<const Observer*>& named) {
    // A map has room for fewer names; more than these would only be tried in vain.
    constexpr std::size_t kMostTried = 1000;
    LabelPlaces places;
    const Point2 arrow = north_arrow();
    const double around = kArrowRadius * unit_;
    places.take({arrow.x - around, arrow.y - around, arrow.x + around, arrow.y + around});
    const double mark = 0.62 * unit_;
    for (const Observer* observer : named) {
      const Point2 at = place_of(observer->position);
      places.take({at.x - mark, at.y - mark, at.x + mark, at.y + mark});
    }
    const int size = unit_ * 5 / 4;
    const Box frame{1.0 * left_, 1.0 * top_, 1.0 * (left_ + width_), 1.0 * (top_ + height_)};
    std::size_t drawn = 0;
    for (const Observer* observer : std::span(named).first(std::min(named.size(), kMostTried))) {
      const MarkLabel label{place_of(observer->position), 0.9 * unit_, 1.0 * letters_.width(observer->name, size),
                            0.72 * size, 2};
      const auto baseline = places.take_beside(label, frame);
      if (!baseline) continue;
      letters_.draw_with_rim(canvas_, observer->name, *baseline, size, kInk);
      ++drawn;
    }
    return drawn;
  }

  std::string subtitle() const {
    if (!options_.subtitle.empty()) return options_.subtitle;
    const Request& r = result_.request;
    const Observer& first = r.observers.front();
    const bool alike = std::all_of(r.observers.begin(), r.observers.end(), [&](const Observer& o) {
      return o.height == first.height && o.absolute == first.absolute;
    });
    std::string text = r.observers.size() == 1 ? "Observer" : fmt::format("{} observers", r.observers.size());
    const auto height = [](double metres, bool absolute) {
      return fmt::format("{} {:g} m {}", absolute ? " at" : "", metres, absolute ? "elevation" : "above ground");
    };
    if (alike) text += height(first.height, first.absolute);
    if (r.mode != Mode::kHeight) text += ", target" + height(r.target_height, r.target_absolute);
    if (r.radius) text += ", within " + length_text(*r.radius);
    text += fmt::format("; cells of {}", length_text(result_.grid.cell_width()));
    return text;
  }

  void draw_heading() {
    letters_.draw(canvas_, options_.title, {static_cast<double>(left_), 2.9 * unit_}, 2 * unit_, kInk);
    letters_.draw(canvas_, subtitle(), {static_cast<double>(left_), 5.0 * unit_},
                  fitting_size(subtitle(), width_, unit_ * 5 / 4), kFaint);
  }

  /// The largest size up to `size` at which the text is no wider than `width`, though never unreadable.
  int fitting_size(const std::string& text, int width, int size) const {
    while (size > 8 && letters_.width(text, size) > width) --size;
    return size;
  }

  static constexpr double kArrowRadius = 2.3;  ///< radius of the north arrow's disc, units
  Point2 north_arrow() const { return {left_ + width_ - 3.0 * unit_, top_ + 3.2 * unit_}; }

  void draw_north_arrow() {
    const Point2 centre = north_arrow();
    canvas_.fill_disc(centre, kArrowRadius * unit_, kMapPaper, 0.8);
    const Point2 tip{centre.x, centre.y - 1.1 * unit_}, tail{centre.x, centre.y + 0.9 * unit_};
    canvas_.fill_triangle({tip, {centre.x - 0.8 * unit_, centre.y + 1.5 * unit_}, tail}, kInk);
    canvas_.fill_triangle({tip, {centre.x + 0.8 * unit_, centre.y + 1.5 * unit_}, tail}, kFaint);
    letters_.draw(canvas_, "N", {centre.x, centre.y - 1.2 * unit_}, unit_, kInk, Align::kCentre);
  }

  void draw_scale_bar() {
    const double length = round_length(0.25 * pixels_.bounds().width());
    const double pixels = length / pixels_.cell_width();
    constexpr int kParts = 4;
    const int y = top_ + height_ + unit_, thickness = std::max(4, unit_ / 2);
    const int x0 = left_ + width_ - static_cast<int>(std::lround(pixels)) - 2 * unit_;
    for (int i = 0; i < kParts; ++i) {
      const int from = x0 + static_cast<int>(std::lround(pixels * i / kParts));
      const int to = x0 + static_cast<int>(std::lround(pixels * (i + 1) / kParts));
      canvas_.fill_rectangle(from, y, to - from, thickness, i % 2 == 0 ? kInk : kMapPaper);
    }
    canvas_.frame(x0, y, static_cast<int>(std::lround(pixels)), thickness, kInk);
    const double baseline = y + thickness + 1.3 * unit_;
    letters_.draw(canvas_, "0", {static_cast<double>(x0), baseline}, unit_, kInk, Align::kCentre);
    letters_.draw(canvas_, length_text(length), {x0 + pixels, baseline}, unit_, kInk, Align::kCentre);
  }

  int y_of_row(int row) const { return top_ + height_ + unit_ + row * key_height(); }

  /// Draws a patch of the map's colours over level ground, and what it means.
  void draw_key(int row, const std::vector<Tint>& tints, double fade, const std::string& text) {
    const int x = left_, y = y_of_row(row);
    const int width = 2 * unit_, height = 5 * unit_ / 4, bands = static_cast<int>(tints.size());
    canvas_.fill_rectangle(x, y, width, height, {kLevelGrey, kLevelGrey, kLevelGrey});
    canvas_.fill_rectangle(x, y, width, height, kMapPaper, fade);
    for (int i = 0; i < bands; ++i) {
      const int from = width * i / bands, to = width * (i + 1) / bands;
      const Tint& tint = tints[static_cast<std::size_t>(i)];
      canvas_.fill_rectangle(x + from, y, to - from, height, tint.colour, tint.opacity);
    }
    canvas_.frame(x, y, width, height, kFaint);
    draw_key_text(text, y);
  }

  /// Draws a key's text, which leaves room for the scale beside it, or else for the scale bar.
  void draw_key_text(const std::string& text, int y) {
    const double indent = 2.6 * unit_;
    const int room = width_ * (overlay_.scale().empty() ? 7 : 4) / 10 - static_cast<int>(indent) - unit_;
    letters_.draw(canvas_, text, {left_ + indent, y + 1.05 * unit_}, fitting_size(text, room, unit_), kInk);
  }

  void draw_void_key(int row) {
    const int x = left_, y = y_of_row(row);
    const int width = 2 * unit_, height = 5 * unit_ / 4;
    for (int i = 0; i < width; ++i)
      for (int j = 0; j < height; ++j) draw_void(x + i, y + j);
    canvas_.frame(x, y, width, height, kFaint);
    draw_key_text(options_.no_data_text, y);
  }

  void draw_legend() {
    int row = 0;
    for (const MapOverlay::Key& key : overlay_.keys()) draw_key(row++, key.tints, 0, key.text);
    if (has_outside_) draw_key(row++, {}, kOutsideFade, options_.outside);
    if (has_void_) draw_void_key(row++);
    if (!options_.beyond_text.empty())
      letters_.draw(canvas_, options_.beyond_text, {static_cast<double>(left_), y_of_row(row) + 1.05 * unit_},
                    fitting_size(options_.beyond_text, width_ * 2 / 5 - unit_, unit_), kInk);
    const double y = top_ + height_ + 6.9 * unit_ + further_rows() * key_height();
    draw_mark({left_ + 1.0 * unit_, y});
    const char* observers = result_.request.observers.size() == 1 ? "Observer" : "Observers";
    std::string marks = options_.observers.empty() ? observers : options_.observers;
    if (!names_left_out_.empty()) marks += "; " + names_left_out_;
    letters_.draw(canvas_, marks, {left_ + 2.6 * unit_, y + 0.4 * unit_},
                  fitting_size(marks, width_ / 2 - 3 * unit_, unit_), kInk);
    const std::string earth = result_.request.earth.convention();
    letters_.draw(canvas_, earth, {static_cast<double>(left_ + width_), y + 0.4 * unit_},
                  fitting_size(earth, width_ / 2, unit_ * 9 / 10), kFaint, Align::kRight);
    double below = y + 2.0 * unit_;
    for (const std::string& line : source_lines()) {
      letters_.draw(canvas_, line, {static_cast<double>(left_), below},
                    fitting_size(line, canvas_.width() - 2 * left_, unit_ * 9 / 10), kFaint);
      below += source_height();
    }
    if (!overlay_.scale().empty()) draw_scale();
  }

  /// Draws the overlay's steps side by side, in the middle of the lower margin.
  void draw_scale() {
    const std::vector<MapOverlay::Step>& steps = overlay_.scale();
    const int x0 = left_ + width_ * 2 / 5, y = top_ + height_ + unit_, step = 4 * unit_;
    letters_.draw(canvas_, overlay_.scale_title(), {static_cast<double>(x0), y + 1.0 * unit_}, unit_, kInk);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const Tint& tint = steps[i].tint;
      const int x = x0 + static_cast<int>(i) * step;
      canvas_.fill_rectangle(x, y + 7 * unit_ / 4, step, 5 * unit_ / 4, {kLevelGrey, kLevelGrey, kLevelGrey});
      canvas_.fill_rectangle(x, y + 7 * unit_ / 4, step, 5 * unit_ / 4, tint.colour, tint.opacity);
      letters_.draw(canvas_, steps[i].text, {x + 0.5 * step, y + 4.2 * unit_},
                    fitting_size(steps[i].text, step - 4, unit_), kInk, Align::kCentre);
    }
  }

  const Result& result_;
  const MapOptions& options_;
  RasterGrid pixels_;
  std::vector<float> shades_;  ///< the ground's, one for each pixel
  int width_, height_;         ///< the size of the map proper, pixels
  int unit_;                   ///< everything else is measured in this, pixels
  MapOverlay overlay_;
  bool has_void_, has_outside_;  ///< the map shows places in view without ground, or outside the field of view
  std::string names_left_out_;   ///< a phrase of the legend; empty: all have room
  Canvas canvas_;
  int left_, top_;  ///< where the map proper begins on the canvas
  Lettering letters_;
};

}  // namespace

MapImage draw_map(const Tin& tin, const Result& result, const MapOptions& options) {
  require_possible(options);
  return MapDrawing([&](const RasterGrid& pixels) { return heights_at(tin, pixels); }, result, options).draw();
}

MapImage draw_map(Surface& surface, const Result& result, Progress& progress, const MapOptions& options) {
  if (!surface.lattice) return draw_map(surface.tin, result, options);
  require_possible(options);
  surface.lattice->read_all(progress);
  const LatticeTin& lattice = surface.lattice->lattice();
  return MapDrawing([&](const RasterGrid& pixels) { return heights_at(lattice, pixels); }, result, options).draw();
}

}  // namespace itin::viewshed
