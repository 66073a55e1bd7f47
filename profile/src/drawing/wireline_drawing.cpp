#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/geodesic.hpp>
#include <profile/wireline.hpp>

#include "drawing/axis.hpp"
#include "drawing/drawing.hpp"
#include "drawing/palette.hpp"

namespace itin::profile {

namespace {

constexpr double kPerDegree = 17;  ///< points: 53.5 degrees are 321 mm wide, to be seen from 344 mm
constexpr double kMillimetre = 72 / 25.4;
constexpr double kLeft = 46, kRight = 16, kTop = 62, kBottom = 56;
constexpr Colour kDegreeLine{0.90, 0.90, 0.90};
constexpr Colour kTurbine{0.80, 0.16, 0.10};

struct PlacedTurbine {
  const WirelineTurbine* turbine;
  double distance, across, base, top;  ///< metres; degrees from the left edge and of elevation
};

class WirelinePage {
 public:
  WirelinePage(const Wireline& view, Drawing::Format format)
      : view_(view), query_(view.query), turbines_(place_turbines()) {
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
    drawing_->clip(frame_);
    draw_terrain_and_turbines();
    drawing_->unclip();
    draw_labels();
    draw_axes();
    return drawing_->finish();
  }

 private:
  std::vector<PlacedTurbine> place_turbines() const {
    std::vector<PlacedTurbine> placed;
    for (const WirelineTurbine& t : query_.turbines) {
      const double dx = t.position.x - query_.eye.x, dy = t.position.y - query_.eye.y, d = std::hypot(dx, dy);
      double across = std::fmod(std::atan2(dx, dy) * kDegreesPerRadian - query_.from_deg, 360);
      if (across < 0) across += 360;
      if (across > query_.width_deg || d > query_.reach_m || d == 0) continue;
      const double foot = t.ground_m - query_.eye_elevation_m;
      placed.push_back({&t, d, across, apparent_angle_deg(query_.earth, d, foot),
                        apparent_angle_deg(query_.earth, d, foot + t.tip_m)});
    }
    std::stable_sort(placed.begin(), placed.end(),
                     [](const PlacedTurbine& a, const PlacedTurbine& b) { return a.distance > b.distance; });
    return placed;
  }

  /// From a degree below the lowest skyline to above everything, but for what towers over the eye, such as a house
  /// beside it: that is cut off.
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
    drawing_->text({kLeft, 20}, query_.title, {.size = 12, .colour = kInk, .bold = true});
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

  /// From the farthest to the nearest: what is nearer covers what is behind it.
  void draw_terrain_and_turbines() {
    auto turbine = turbines_.begin();
    for (auto band = view_.bands.rbegin(); band != view_.bands.rend(); ++band) {
      // A turbine on a limit stands in front of the band behind it. Limits are at most a metre from turbines.
      for (; turbine != turbines_.end() && turbine->distance >= band->to_m - 0.5; ++turbine) draw_turbine(*turbine);
      draw_band(*band);
    }
    for (; turbine != turbines_.end(); ++turbine) draw_turbine(*turbine);
  }

  void draw_band(const WirelineBand& band) {
    const std::size_t lines = band.angle_deg.size();
    for (std::size_t first = 0; first < lines;) {
      if (std::isnan(band.angle_deg[first])) {
        ++first;
        continue;
      }
      std::size_t last = first;
      while (last + 1 < lines && !std::isnan(band.angle_deg[last + 1])) ++last;
      draw_stretch(band, first, last);
      first = last + 1;
    }
  }

  Point2 at(const WirelineBand& band, std::size_t i) const {
    const double across = std::min(static_cast<double>(i) * query_.step_deg, query_.width_deg);
    return {x_at(across), y_at(std::max<double>(band.angle_deg[i], low_ - 1))};
  }

  void draw_stretch(const WirelineBand& band, std::size_t first, std::size_t last) {
    std::vector<Point2> outline;
    for (std::size_t i = first; i <= last; ++i) outline.push_back(at(band, i));
    outline.push_back({outline.back().x, frame_.ymax + kPerDegree});
    outline.push_back({outline.front().x, frame_.ymax + kPerDegree});
    drawing_->polygon(outline, kPaper);
    const Stroke stroke = stroke_of(band);
    std::vector<Point2> crest;
    for (std::size_t i = first; i <= last; ++i) {
      if (band.crest[i]) crest.push_back(at(band, i));
      if (band.crest[i] && i < last) continue;
      if (crest.size() > 1) drawing_->polyline(crest, stroke);
      crest.clear();
    }
  }

  /// The farther, the fainter.
  Stroke stroke_of(const WirelineBand& band) const {
    const double far = std::log(band.to_m / 20) / std::log(query_.reach_m / 20);
    const double grey = 0.05 + 0.55 * std::clamp(far, 0.0, 1.0);
    return {{grey, grey, grey}, 1.1 - 0.6 * std::clamp(far, 0.0, 1.0), {}};
  }

  void draw_turbine(const PlacedTurbine& placed) {
    const WirelineTurbine& t = *placed.turbine;
    const Stroke stroke{kTurbine, 0.8, {}};
    const double x = x_at(placed.across), foot = t.ground_m - query_.eye_elevation_m;
    const auto y = [&](double height) {
      return y_at(apparent_angle_deg(query_.earth, placed.distance, foot + height));
    };
    if (!t.hub_m || *t.hub_m >= t.tip_m) {
      drawing_->polyline(std::array{Point2{x, y(0)}, Point2{x, y(t.tip_m)}}, stroke);
      return;
    }
    const Point2 hub{x, y(*t.hub_m)};
    drawing_->polyline(std::array{Point2{x, y(0)}, hub}, stroke);
    const double radius = hub.y - y(t.tip_m);
    for (const double turn : {0.0, 120.0, 240.0}) {
      const double a = turn / kDegreesPerRadian;
      drawing_->polyline(std::array{hub, Point2{hub.x + radius * std::sin(a), hub.y - radius * std::cos(a)}}, stroke);
    }
    std::vector<Point2> circle;
    for (int i = 0; i <= 48; ++i) {
      const double a = i * 2 * std::numbers::pi / 48;
      circle.push_back({hub.x + radius * std::sin(a), hub.y - radius * std::cos(a)});
    }
    drawing_->polyline(circle, {kTurbine, 0.35, {}});
  }

  /// Numbers above the tips seen, in rows so that neighbours do not touch.
  void draw_labels() {
    std::vector<const PlacedTurbine*> seen;
    for (const PlacedTurbine& t : turbines_)
      if (t.turbine->seen) seen.push_back(&t);
    std::sort(seen.begin(), seen.end(), [](const auto* a, const auto* b) { return a->across < b->across; });
    std::array<double, 5> ends;
    ends.fill(-1e9);
    const Lettering lettering{.size = 6, .colour = kTurbine, .align = Align::kCentre};
    for (const PlacedTurbine* t : seen) {
      const double half = drawing_->text_width(t->turbine->label, lettering) / 2 + 1, x = x_at(t->across);
      const auto row = std::find_if(ends.begin(), ends.end(), [&](double end) { return end < x - half; });
      if (row == ends.end()) continue;
      *row = x + half;
      const double y = y_at(t->top) - 3 - 7 * static_cast<double>(row - ends.begin());
      drawing_->text({x, std::max(y, frame_.ymin + 6)}, t->turbine->label, lettering);
    }
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
      drawing_->text({x, frame_.ymax + 14}, fmt::format("{:g}", std::fmod(a + 720, 360)),
                     {.size = 8, .colour = kInk, .align = Align::kCentre});
    }
    for (double e = std::ceil(low_); e <= high_; e += 1)
      drawing_->text({frame_.xmin - 5, y_at(e) + 3}, fmt::format("{:+g}", e),
                     {.size = 8, .colour = kInk, .align = Align::kRight});
    drawing_->text({(frame_.xmin + frame_.xmax) / 2, frame_.ymax + 28}, "azimuth from grid north, degrees",
                   {.size = 8, .colour = kInk, .align = Align::kCentre});
    drawing_->text({14, (frame_.ymin + frame_.ymax) / 2}, "elevation, degrees",
                   {.size = 8, .colour = kInk, .align = Align::kCentre, .turn_deg = 90});
    drawing_->text(
        {frame_.xmin, frame_.ymax + 44},
        fmt::format("Cylindrical, to scale: one degree is {:.1f} mm across and up; seen as in nature from "
                    "{:.0f} mm. {:g} degrees are shown.",
                    kPerDegree / kMillimetre, kPerDegree * kDegreesPerRadian / kMillimetre, query_.width_deg),
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
