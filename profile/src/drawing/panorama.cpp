#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <itin/azimuth.hpp>
#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/label_places.hpp>
#include <profile/chart.hpp>

#include "drawing/axis.hpp"
#include "drawing/drawing.hpp"
#include "drawing/label_row.hpp"
#include "drawing/palette.hpp"

namespace itin::profile {

namespace {

constexpr double kPanoramaWidth = 1260, kPanoramaHeight = 420;
constexpr double kLongestName = 260;
const Lettering kPlaceNames{.size = 8, .colour = kInk, .rotation_deg = 50};
// Colours from the palette of Okabe and Ito, which differ with every kind of colour blindness.
constexpr Colour kSky{0.93, 0.96, 0.98}, kSeen{0.00, 0.45, 0.70}, kHidden{0.84, 0.37, 0.00};
constexpr std::array<Colour, 5> kNearToFar{
    {{0.36, 0.36, 0.33}, {0.47, 0.48, 0.46}, {0.57, 0.59, 0.60}, {0.67, 0.70, 0.72}, {0.77, 0.80, 0.83}}};

/// The sky line where the data ends.
const Stroke kDataEdge{{0.80, 0.10, 0.45, 1}, 2.2, {}};

std::string azimuth_text(double degrees) {
  constexpr std::array<const char*, 8> kNames{"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  const double turned = within_turn(degrees);
  const double eighth = turned / 45;
  return eighth == std::floor(eighth) ? kNames[static_cast<std::size_t>(eighth) % 8] : fmt::format("{:g}°", turned);
}

struct PlaceName {
  const PanoramaPlace* place;
  std::string text;
  double x, label;  ///< the place's column, and where its name begins
};

class PanoramaPage {
 public:
  PanoramaPage(const Panorama& panorama, Drawing::Format format)
      : panorama_(panorama), frame_{52, 130, kPanoramaWidth - 18, kPanoramaHeight - 66} {
    if (panorama.skyline.size() < 2)
      throw InputError("a panorama of fewer than two azimuths: widen `azimuth`", "azimuth");
    in_km_ = is_far();
    unwrap();
    x_ = {azimuths_.front(), azimuths_.back(), frame_.xmin, frame_.xmax};
    place_names(format);
    place_elevations();
    sort_distances();
  }

  std::string run() {
    drawing_->rectangle({0, 0, drawing_->width(), drawing_->height()}, kPaper);
    drawing_->text({frame_.xmin, 20}, panorama_.title, {.size = 12, .colour = kInk, .bold = true});
    drawing_->text({frame_.xmin, 34}, panorama_.note, {.size = 8, .colour = kFaint});
    drawing_->rectangle(frame_, kSky);
    draw_grid();
    drawing_->clip(frame_);
    for (std::size_t i = 0; i + 1 < azimuths_.size(); ++i) draw_piece(i);
    drawing_->unclip();
    draw_places();
    draw_axes();
    draw_legend();
    return drawing_->finish();
  }

 private:
  /// Turns the azimuths into ones that grow all the way.
  void unwrap() {
    double turns = 0, before = -1;
    for (const SkylinePoint& p : panorama_.skyline) {
      if (p.azimuth_deg < before) turns += 360;
      before = p.azimuth_deg;
      azimuths_.push_back(p.azimuth_deg + turns);
    }
    step_ = (azimuths_.back() - azimuths_.front()) / static_cast<double>(azimuths_.size() - 1);
  }

  /// Finds the places of names. The page grows upwards and to the right with them.
  void place_names(Drawing::Format format) {
    const Drawing measure(format, 1, 1);
    std::vector<RowPlace> wanted;
    for (const PanoramaPlace& place : panorama_.places) {
      const auto x = column_of(place.azimuth_deg);
      if (!x) continue;
      const std::string text = place.name + ", " + distance_text(place.distance_m);
      marks_.push_back({&place, measure.fitted(text, kLongestName, kPlaceNames), *x, *x});
      // A place that is seen matters more than one that is hidden, and a near one more than a far one.
      wanted.push_back({*x, (place.visible ? 1 : 0) + 1 / (2 + place.distance_m)});
    }
    const double turn = in_radians(kPlaceNames.rotation_deg);
    double width = kPanoramaWidth, top = frame_.ymin;
    for (const RowLabel& label : label_row(wanted, {.from = frame_.xmin, .to = frame_.xmax})) {
      PlaceName& name = names_.emplace_back(marks_[label.index]);
      name.label = label.at;
      const double length = measure.text_width(name.text, kPlaceNames);
      width = std::max(width, name.label + length * std::cos(turn) + 10);
      top = std::max(top, 56 + length * std::sin(turn));
    }
    const double down = std::round(top - frame_.ymin);
    frame_.ymin += down, frame_.ymax += down;
    drawing_.emplace(format, std::round(width), kPanoramaHeight + down);
  }

  void place_elevations() {
    double low = 0, high = 0;
    const auto extend = [&](double elevation) {
      if (std::isnan(elevation)) return;
      low = std::min(low, elevation), high = std::max(high, elevation);
    };
    for (const SkylinePoint& p : panorama_.skyline) extend(p.elevation_deg);
    for (const PanoramaPlace& p : panorama_.places) extend(p.elevation_deg);
    const double margin = std::max(0.12 * (high - low), 0.2);
    y_ = {low - 2 * margin, high + margin, frame_.ymax, frame_.ymin};
  }

  /// All distances are in one unit: kilometres where anything is 2 km away.
  std::string distance_text(double metres) const {
    return in_km_ ? fmt::format("{:.1f} km", metres / 1000) : fmt::format("{:.0f} m", metres);
  }
  bool is_far() const {
    const auto far = [](const auto& p) { return p.distance_m >= 2000; };
    return std::any_of(panorama_.skyline.begin(), panorama_.skyline.end(), far) ||
           std::any_of(panorama_.places.begin(), panorama_.places.end(), far);
  }

  /// Sets limits between the shades, so that each has an equal share of the sky line.
  void sort_distances() {
    std::vector<double> distances;
    for (const SkylinePoint& p : panorama_.skyline)
      if (!std::isnan(p.elevation_deg)) distances.push_back(p.distance_m);
    std::sort(distances.begin(), distances.end());
    for (std::size_t i = 1; i < kNearToFar.size() && !distances.empty(); ++i)
      limits_.push_back(distances[distances.size() * i / kNearToFar.size()]);
  }

  const Colour& shade(double distance) const {
    const auto limit = std::upper_bound(limits_.begin(), limits_.end(), distance);
    return kNearToFar[static_cast<std::size_t>(limit - limits_.begin())];
  }

  /// Draws the ground below the sky line from one azimuth to the next.
  void draw_piece(std::size_t i) {
    const SkylinePoint &p = panorama_.skyline[i], &q = panorama_.skyline[i + 1];
    if (std::isnan(p.elevation_deg) || std::isnan(q.elevation_deg)) return;
    // The piece is a hair wider, lest the paper shines through between two pieces.
    const double from = x_.at(azimuths_[i]), to = x_.at(azimuths_[i + 1]) + 0.15;
    const double a = y_.at(p.elevation_deg), b = y_.at(q.elevation_deg);
    const std::array<Point2, 4> piece{Point2{from, a}, {to, b}, {to, frame_.ymax}, {from, frame_.ymax}};
    drawing_->polygon(piece, shade(std::min(p.distance_m, q.distance_m)));
    const std::array<Point2, 2> edge{Point2{from, a}, {to, b}};
    const bool ends = p.data_edge && q.data_edge;
    if (ends) has_data_edge_ = true;
    drawing_->polyline(edge, ends ? kDataEdge : Stroke{kInk, 0.6, {}});
  }

  void draw_grid() {
    for (const double elevation : y_.ticks(7)) {
      const std::array<Point2, 2> line{Point2{frame_.xmin, y_.at(elevation)}, {frame_.xmax, y_.at(elevation)}};
      drawing_->polyline(line, {elevation == 0 ? kFaint : kGrid, elevation == 0 ? 0.8 : 0.5, {}});
    }
  }

  void draw_axes() {
    const double step = y_.step(7);
    for (const double elevation : y_.ticks(7))
      drawing_->text({frame_.xmin - 5, y_.at(elevation) + 3}, tick_label(elevation, step) + "°",
                     {.size = 8, .colour = kInk, .align = Align::kRight});
    const double range = x_.high - x_.low;
    const double every = range > 200 ? 22.5 : range > 60 ? 15 : range > 20 ? 5 : 1;
    for (double azimuth = std::ceil(x_.low / every - 1e-9) * every; azimuth <= x_.high + 1e-9; azimuth += every) {
      const double x = x_.at(azimuth);
      const std::array<Point2, 2> mark{Point2{x, frame_.ymax}, {x, frame_.ymax + 4}};
      drawing_->polyline(mark, {kInk, 0.7, {}});
      drawing_->text({x, frame_.ymax + 14}, azimuth_text(azimuth),
                     {.size = 8, .colour = kInk, .align = Align::kCentre});
    }
    const std::array<Point2, 5> outline{Point2{frame_.xmin, frame_.ymin},
                                        {frame_.xmax, frame_.ymin},
                                        {frame_.xmax, frame_.ymax},
                                        {frame_.xmin, frame_.ymax},
                                        {frame_.xmin, frame_.ymin}};
    drawing_->polyline(outline, {kInk, 0.8, {}});
  }

  /// The place of an azimuth on the axis; nothing beyond its ends.
  std::optional<double> column_of(double azimuth) const {
    for (const double turned : {azimuth, azimuth + 360})
      if (turned >= x_.low - step_ && turned <= x_.high + step_)
        return std::clamp(x_.at(turned), frame_.xmin, frame_.xmax);
    return std::nullopt;
  }

  void draw_mark(Point2 at, bool visible) {
    drawing_->circle(at, 3.6, kPaper);
    drawing_->circle(at, 3.0, visible ? kSeen : kHidden);
    if (!visible) drawing_->circle(at, 1.7, kPaper);
  }

  void draw_places() {
    for (const PlaceName& name : names_) {
      const std::array<Point2, 3> leader{mark_of(name), {name.x, frame_.ymin}, {name.label, frame_.ymin - 8}};
      drawing_->polyline(leader, {name.place->visible ? kSeen : kHidden, 0.5, {}});
      Lettering lettering = kPlaceNames;
      if (!name.place->visible) lettering.colour = kFaint;
      drawing_->text({name.label + 2, frame_.ymin - 10}, name.text, lettering);
    }
    for (const PlaceName& name : marks_) draw_mark(mark_of(name), name.place->visible);
  }

  Point2 mark_of(const PlaceName& name) const { return {name.x, y_.at(name.place->elevation_deg)}; }

  void draw_legend() {
    const double y = drawing_->height() - 22;
    double x = frame_.xmin;
    drawing_->text({x, y}, "Distance of the sky line", {.size = 8, .colour = kInk});
    x += 110;
    for (std::size_t i = 0; i <= limits_.size(); ++i) {
      drawing_->rectangle({x, y - 8, x + 24, y + 1}, kNearToFar[i]);
      const std::string text = i < limits_.size() ? "to " + distance_text(limits_[i]) : std::string("beyond");
      drawing_->text({x + 28, y}, text, {.size = 8, .colour = kInk});
      x += 90;
    }
    if (has_data_edge_) {
      const std::array<Point2, 2> sample{Point2{x, y - 3}, {x + 24, y - 3}};
      drawing_->polyline(sample, kDataEdge);
      drawing_->text({x + 28, y}, "edge of the data", {.size = 8, .colour = kInk});
      x += 110;
    }
    if (panorama_.places.empty()) return;
    for (const bool visible : {true, false}) {
      draw_mark({x + 4, y - 3}, visible);
      drawing_->text({x + 12, y}, visible ? "in line of sight" : "hidden", {.size = 8, .colour = kInk});
      x += 90;
    }
    if (const std::size_t without = marks_.size() - names_.size(); without > 0)
      drawing_->text({x - 30, y}, left_out_text(without, marks_.size()), {.size = 8, .colour = kInk});
  }

  const Panorama& panorama_;
  std::optional<Drawing> drawing_;
  Box frame_;
  std::vector<PlaceName> marks_, names_;  ///< all places in view, and the named ones, from left to right
  std::vector<double> azimuths_;
  double step_ = 0;
  std::vector<double> limits_;
  bool has_data_edge_ = false, in_km_ = false;
  Axis x_, y_;
};

}  // namespace

void require_panorama_format(const std::string& path) {
  if (!Drawing::format_of(path)) throw InputError(path + ": a panorama is written as .svg, .pdf or .png");
}

std::string draw_panorama(const Panorama& panorama, const std::string& path) {
  require_panorama_format(path);
  return PanoramaPage(panorama, *Drawing::format_of(path)).run();
}

}  // namespace itin::profile
