#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <itin/azimuth.hpp>
#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <profile/wireline.hpp>

#include "drawing/axis.hpp"
#include "drawing/drawing.hpp"
#include "drawing/palette.hpp"
#include "drawing/wireline_scene.hpp"

namespace itin::profile {

namespace {

constexpr double kPerDegree = 17;  ///< points: 53.5 degrees are 321 mm wide, to be seen from 344 mm
constexpr double kMillimetre = 72 / 25.4;
constexpr double kLeft = 46, kRight = 16, kTop = 62, kBottom = 56;
constexpr Colour kDegreeLine{0.90, 0.90, 0.90};

class WirelinePage {
 public:
  WirelinePage(const Wireline& view, Drawing::Format format)
      : view_(view), query_(view.query), turbines_(placed_turbines(query_)) {
    choose_elevations();
    width_ = query_.width_deg * kPerDegree;
    height_ = (high_ - low_) * kPerDegree;
    drawing_.emplace(format, kLeft + width_ + kRight, kTop + height_ + kBottom);
    frame_ = {kLeft, kTop, kLeft + width_, kTop + height_};
  }

  std::string run() {
    drawing_->rectangle({0, 0, drawing_->width(), drawing_->height()}, kPaper);
    draw_heading();
    draw_grid();
    WirelineScene(view_, frame_,
                  [&](double across, double elevation) {
                    return Point2{x_at(across), y_at(elevation)};
                  },
                  {0, query_.width_deg, 6})
        .draw(*drawing_);
    draw_farm_names(*drawing_, query_, {frame_.xmax, frame_.ymin - 6}, 8, 10);
    draw_axes();
    return drawing_->finish();
  }

 private:
  /// Chooses elevations from a degree below the lowest skyline to above everything, except things that tower over the
  /// eye, such as a house beside it, which are cut off.
  void choose_elevations() {
    const std::size_t lines = view_.bands.front().angle_deg.size();
    double lowest = 90, highest = -90;
    for (std::size_t i = 0; i < lines; ++i) {
      double skyline = -90;
      for (const WirelineBand& band : view_.bands)
        if (!std::isnan(band.angle_deg[i])) skyline = std::max<double>(skyline, band.angle_deg[i]);
      if (skyline > -90) lowest = std::min(lowest, skyline), highest = std::max(highest, skyline);
    }
    constexpr double kTowering = 30;
    highest = std::min(highest, kTowering);
    for (const PlacedTurbine& t : turbines_) highest = std::max(highest, t.top), lowest = std::min(lowest, t.top);
    if (lowest > highest) lowest = highest < -89 ? -1 : highest - 3, highest = std::max(highest, 1.0);
    low_ = std::max(std::floor(lowest * 2 - 3) / 2, -15.0);
    high_ = std::min(std::max(std::ceil(highest * 2 + 1) / 2, low_ + 3), 60.0);
  }

  double x_at(double across) const { return frame_.xmin + across * kPerDegree; }
  double y_at(double elevation) const { return frame_.ymax - (elevation - low_) * kPerDegree; }

  void draw_heading() {
    drawing_->text({kLeft, 20}, query_.title,
                   drawing_->lettering_for(query_.title, width_, 1, {.size = 12, .colour = kInk, .bold = true}));
    double y = 33;
    for (const std::string& note : query_.notes) {
      drawing_->text({kLeft, y}, note, {.size = 8, .colour = kFaint});
      y += 11;
    }
  }

  void draw_grid() {
    for (double e = std::ceil(low_); e <= high_; e += 1)
      drawing_->polyline(std::array{Point2{frame_.xmin, y_at(e)}, Point2{frame_.xmax, y_at(e)}},
                         {e == 0 ? kFaint : kDegreeLine, 0.5, {}});
  }

  void draw_axes() {
    const Stroke ink{kInk, 0.8, {}};
    drawing_->polyline(std::array{Point2{frame_.xmin, frame_.ymin}, Point2{frame_.xmin, frame_.ymax},
                                  Point2{frame_.xmax, frame_.ymax}},
                       ink);
    const double step = query_.width_deg > 120 ? 10 : 5;
    for (double a = std::ceil(query_.from_deg / step) * step; a <= query_.from_deg + query_.width_deg; a += step) {
      const double x = x_at(a - query_.from_deg);
      drawing_->polyline(std::array{Point2{x, frame_.ymax}, Point2{x, frame_.ymax + 4}}, ink);
      drawing_->text({x, frame_.ymax + 14}, fmt::format("{:g}", within_turn(a)),
                     {.size = 8, .colour = kInk, .align = Align::kCentre});
    }
    for (double e = std::ceil(low_); e <= high_; e += 1)
      drawing_->text({frame_.xmin - 5, y_at(e) + 3}, fmt::format("{:+g}", e + 0.0),
                     {.size = 8, .colour = kInk, .align = Align::kRight});
    drawing_->text({(frame_.xmin + frame_.xmax) / 2, frame_.ymax + 28}, "azimuth from grid north, degrees",
                   {.size = 8, .colour = kInk, .align = Align::kCentre});
    drawing_->text({14, (frame_.ymin + frame_.ymax) / 2}, "elevation, degrees",
                   {.size = 8, .colour = kInk, .align = Align::kCentre, .rotation_deg = 90});
    drawing_->text({frame_.xmin, frame_.ymax + 44},
                   fmt::format("Cylindrical, to scale: one degree is {:.1f} mm across and up; at a viewing distance of "
                               "{:.0f} mm it matches the view in nature. {:g} degrees are shown.",
                               kPerDegree / kMillimetre, kPerDegree * in_degrees(1) / kMillimetre, query_.width_deg),
                   {.size = 8, .colour = kFaint});
  }

  const Wireline& view_;
  const WirelineQuery& query_;
  std::vector<PlacedTurbine> turbines_;  ///< from the farthest
  double low_ = -1, high_ = 1;           ///< elevations shown, degrees
  double width_ = 0, height_ = 0;
  Box frame_;
  std::optional<Drawing> drawing_;
};

}  // namespace

std::string draw_wireline(const Wireline& view, const std::string& path) {
  const auto format = Drawing::format_of(path);
  if (!format) throw InputError(fmt::format("{}: a wireline ends in .svg, .pdf or .png", path));
  if (view.bands.empty()) throw InputError("a wireline without terrain");
  return WirelinePage(view, *format).run();
}

}  // namespace itin::profile
