#include "report/charts/sight_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include <profile/report_text.hpp>
#include <profile/sight_svg.hpp>

#include "drawing/theme_colour.hpp"
#include "report/charts/fade.hpp"
#include "report/tables/tables.hpp"

namespace itin::profile {

namespace {

constexpr int kArcParts = 240;
constexpr Colour kChartGround{0.80, 0.74, 0.62, 1}, kGroundLine{0.42, 0.33, 0.20, 1}, kRay{0.05, 0.25, 0.60, 1},
    kZone{0.20, 0.45, 0.85, 0.13}, kInnerZone{0.20, 0.45, 0.85, 0.16}, kZoneLine{0.20, 0.45, 0.85, 1},
    kWorst{0.75, 0.35, 0.05, 1}, kCut{0.80, 0.10, 0.10, 0.45}, kMarker{0.75, 0.05, 0.05, 1}, kNoData{0.9, 0.9, 0.9, 1},
    kWhite{1, 1, 1, 0.85}, kFeatureLine{0.30, 0.20, 0.20, 1}, kChartSeen{0.00, 0.62, 0.45, 1},
    kUnseen{0.62, 0.62, 0.62, 1};

const Stroke kBullingtonLine{{0.45, 0.15, 0.55, 1}, 0.9, {5, 2, 1, 2}}, kDeygoutMark{{0.45, 0.15, 0.55, 1}, 2.2, {}},
    kReflectedPath{{0.10, 0.45, 0.30, 1}, 0.8, {3, 2}};

/// Draws everything in metres over the chord between the ends' verticals.
class SightChart {
 public:
  SightChart(Drawing& drawing, const Box& area, const LosReport& report)
      : drawing_(drawing),
        report_(report),
        length_(std::max(report.profile.length_m, 1e-3)),
        drop_(report.query.earth.drop_coefficient()),
        wavelength_(report.query.radio ? wavelength_m(report.query.radio->frequency_ghz) : 0),
        dense_(with_spacing(report.profile, length_ / kArcParts)),
        ground_(report.ground.points.empty() ? dense_ : with_spacing(report.ground, length_ / kArcParts)) {
    find_worst();
    const auto [low, high] = range();
    frame_ = make_frame({area.xmin + 52, area.ymin, area.xmax - 12, area.ymax - 66}, 0, length_, low, high);
  }

  void draw() {
    drawing_.clip(frame_.box);
    draw_arcs();
    draw_gaps();
    draw_features();
    draw_ground();
    draw_zones();
    draw_cuts();
    draw_lines();
    draw_edges();
    draw_reflection();
    drawing_.unclip();
    draw_axes();
    draw_object();
    draw_critical();
    draw_masts();
    draw_key();
  }

 private:
  double bulge(double d) const { return drop_ * d * (length_ - d); }
  double ray(double d) const { return ray_elevation_m(report_, d); }
  double radius(double d) const { return fresnel_radius_m(d, length_ - d, wavelength_); }
  Point2 at(double d, double height) const { return frame_.at(d, height); }
  Point2 at(const ProfilePoint& p) const { return at(p.distance_m, p.ground_m + bulge(p.distance_m)); }

  void find_worst() {
    const CriterionResult* fade = worst_fade(report_);
    if (fade == nullptr) return;
    worst_k_ = fade->k;
    worst_drop_ = 1 / (2 * worst_k_ * report_.query.earth.radius);
  }

  std::pair<double, double> range() const {
    double low = std::min(report_.antennas.from_m, report_.antennas.to_m);
    double high = std::max(report_.antennas.from_m, report_.antennas.to_m);
    for (const ProfilePoint& p : dense_.points) {
      const double d = p.distance_m, curve = std::max(drop_, worst_drop_) * d * (length_ - d);
      low = std::min(low, p.ground_m + bulge(d));
      high = std::max({high, p.ground_m + curve, ray(d) + radius(d)});
    }
    if (report_.query.object) high = std::max(high, report_.stands_on.to_m + report_.query.object->tip_m);
    // Bullington's edge may be far above all that there is: beyond as much height again, its lines leave the frame.
    if (const auto edge = bullington())
      high = std::max(high, std::min(edge->elevation_m + bulge(edge->distance_m), high + (high - low)));
    const double span = std::max({high - low, length_ / 200, 1.0});
    return {low - 0.10 * span, high + 0.22 * span};
  }

  std::vector<Point2> sampled(double from, double to, double (SightChart::*height)(double) const) const {
    std::vector<Point2> line;
    for (int i = 0; i <= kArcParts; ++i) {
      const double d = from + (to - from) * (1 - std::cos(std::numbers::pi * i / kArcParts)) / 2;
      line.push_back(at(d, (this->*height)(d)));
    }
    return line;
  }

  void draw_arcs() {
    for (const double tick : frame_.y.ticks(frame_.y_ticks)) {
      std::vector<Point2> arc = sampled(0, length_, &SightChart::bulge);
      for (Point2& p : arc) p.y += frame_.y.at(tick) - frame_.y.at(0);
      drawing_.polyline(arc, {kReportFaint, 0.6, {}});
    }
  }

  void draw_gaps() {
    for (const auto& [from, to] : report_.profile.gaps) {
      const Box& box = frame_.box;
      drawing_.rectangle({frame_.x.at(from), box.ymin, frame_.x.at(to), box.ymax}, kNoData);
      drawing_.text({frame_.x.at((from + to) / 2), box.ymax - 6}, "no data",
                    {7, kReportGrey, Align::kCentre, false, 0});
    }
  }

  /// Calls visit(first, last) for each run of joined points.
  template <class Visit>
  static void for_each_run(const Profile& profile, Visit visit) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < profile.points.size(); ++i) {
      if (i + 1 < profile.points.size() && profile.joined(i)) continue;
      visit(first, i);
      first = i + 1;
    }
  }

  void fill_below(std::vector<Point2> top, const Colour& colour) {
    if (top.size() < 2) return;
    top.push_back({top.back().x, frame_.box.ymax});
    top.push_back({top.front().x, frame_.box.ymax});
    drawing_.polygon(top, colour);
  }

  void draw_ground() {
    for_each_run(ground_, [&](std::size_t first, std::size_t last) {
      std::vector<Point2> ground;
      for (std::size_t i = first; i <= last; ++i) ground.push_back(at(ground_.points[i]));
      fill_below(ground, kChartGround);
      drawing_.polyline(ground, {kGroundLine, 0.9, {}});
    });
  }

  std::vector<Point2> zone(double fraction) const {
    std::vector<Point2> line;
    for (const double side : {1.0, -1.0}) {
      for (int i = 0; i <= kArcParts; ++i) {
        const double angle = std::numbers::pi * (side > 0 ? i : kArcParts - i) / kArcParts;
        const double d = length_ * (1 - std::cos(angle)) / 2;
        line.push_back(at(d, ray(d) + side * fraction * radius(d)));
      }
    }
    return line;
  }
  void draw_zones() {
    if (wavelength_ == 0) return;
    drawing_.polygon(zone(1), kZone);
    drawing_.polygon(zone(0.6), kInnerZone);
    drawing_.polyline(zone(1), {kZoneLine, 0.7, {}});
    drawing_.polyline(zone(0.6), {kZoneLine, 0.6, {3, 2}});
  }

  /// Draws the ground above the ray.
  void draw_cuts() {
    for (const Obstruction& o : report_.obstructions) {
      std::vector<Point2> outline = {at(o.from_m, ray(o.from_m))};
      for (const ProfilePoint& p : dense_.points) {
        if (p.distance_m >= o.from_m && p.distance_m <= o.to_m) outline.push_back(at(p));
      }
      outline.push_back(at(o.to_m, ray(o.to_m)));
      drawing_.polygon(outline, kCut);
    }
  }

  /// Draws features, before the ground, which covers the parts of them within it.
  void draw_features() {
    for (const FeatureRun& run : feature_runs(dense_)) {
      std::vector<Point2> top;
      for (std::size_t i = run.first; i <= run.last; ++i) top.push_back(at(dense_.points[i]));
      fill_below(top, theme_colour(run.theme));
      drawing_.polyline(top, {kFeatureLine, 0.7, {}});
      themes_.insert(run.theme);
    }
  }

  double worst_ground(const ProfilePoint& p) const {
    return p.ground_m + worst_drop_ * p.distance_m * (length_ - p.distance_m);
  }
  void draw_lines() {
    if (worst_k_ > 0) {
      for_each_run(dense_, [&](std::size_t first, std::size_t last) {
        std::vector<Point2> line;
        for (std::size_t i = first; i <= last; ++i) {
          line.push_back(at(dense_.points[i].distance_m, worst_ground(dense_.points[i])));
        }
        drawing_.polyline(line, {kWorst, 0.9, {4, 2}});
      });
    }
    const Point2 sight[] = {at(0, report_.antennas.from_m), at(length_, report_.antennas.to_m)};
    drawing_.polyline(sight, {kRay, 1.3, {}});
  }

  std::optional<DiffractionEdge> bullington() const {
    return report_.losses ? report_.losses->bullington : std::nullopt;
  }
  Point2 top_of(const DiffractionEdge& edge) const {
    return at(edge.distance_m, edge.elevation_m + bulge(edge.distance_m));
  }
  /// Draws a line from antenna to antenna by way of a point.
  void draw_by_way_of(Point2 point, const Stroke& stroke) {
    const Point2 line[] = {at(0, report_.antennas.from_m), point, at(length_, report_.antennas.to_m)};
    drawing_.polyline(line, stroke);
  }
  void draw_edges() {
    if (!report_.losses) return;
    if (const auto edge = bullington()) draw_by_way_of(top_of(*edge), kBullingtonLine);
    for (const DiffractionEdge& edge : report_.losses->deygout) {
      const Point2 top = top_of(edge), mark[] = {{top.x, top.y - 9}, {top.x, top.y + 9}};
      drawing_.polyline(mark, kDeygoutMark);
    }
  }
  void draw_reflection() {
    if (!report_.reflection || !report_.reflection->ground_m) return;
    const double d = report_.reflection->distance_m;
    const Point2 point = at(d, *report_.reflection->ground_m + bulge(d));
    draw_by_way_of(point, kReflectedPath);
    drawing_.circle(point, 2.4, kReflectedPath.colour);
  }

  void draw_axes() {
    const bool km = unit_of(report_) == DistanceUnit::kKilometres;
    frame_.x_title = km ? "Distance from A, km" : "Distance from A, m";
    frame_.y_title = "Elevation, m";
    draw_frame(drawing_, frame_, [km](double value, double step) {
      return km ? tick_label(value / 1000, step / 1000) : tick_label(value, step);
    });
    const double per_metre_up = std::abs(frame_.y.to - frame_.y.from) / (frame_.y.high - frame_.y.low);
    const double per_metre_along = (frame_.x.to - frame_.x.from) / length_;
    drawing_.text({frame_.box.xmax, frame_.box.ymax + 26},
                  fmt::format("Vertical exaggeration {:.3g} : 1", per_metre_up / per_metre_along),
                  {8, kReportInk, Align::kRight, false, 0});
  }

  /// The highest point of the drawn surface.
  double highest_between(double from, double to) const {
    double highest = -std::numeric_limits<double>::infinity();
    for (const ProfilePoint& p : dense_.points) {
      const bool between = p.distance_m >= std::min(from, to) && p.distance_m <= std::max(from, to);
      if (between) highest = std::max(highest, p.ground_m + bulge(p.distance_m));
    }
    return highest;
  }

  void draw_mast(double d, double ground, double antenna, const std::string& name, double height) {
    const bool first = d == 0;
    const Point2 foot = at(d, ground), top = at(d, antenna);
    const Point2 mast[] = {foot, top};
    drawing_.polyline(mast, {kReportInk, 2.2, {}});
    drawing_.circle(top, 2.6, kRay);
    const std::string text = fmt::format("{}, {:g} m", name, std::round(height * 100) / 100);
    const Lettering lettering{8.5, kReportInk, Align::kLeft, true, 0};
    const double width = drawing_.text_width(text, lettering);
    const double x = first ? top.x + 5 : top.x - 5 - width;
    // The label is kept clear of the ray, its zone and the ground, which may rise away from the mast.
    const double end = std::clamp((width + 10) / (frame_.x.to - frame_.x.from), 0.0, 1.0) * length_;
    const double beside = first ? end : length_ - end;
    const double highest = std::max({antenna, ray(beside) + radius(beside), highest_between(d, beside)});
    const double y = std::max(frame_.y.at(highest) - 8, frame_.box.ymin + 24);
    drawing_.rectangle({x - 2, y - 8.5, x + width + 2, y + 3}, kWhite);
    drawing_.text({x, y}, text, lettering);
  }
  void draw_masts() {
    draw_mast(0, report_.stands_on.from_m, report_.antennas.from_m, "A", report_.query.from_height_m);
    draw_mast(length_, report_.stands_on.to_m, report_.antennas.to_m, "B", report_.query.to_height_m);
  }

  /// Draws, beside the second mast, what is seen of the object and what is not, with a mark at its hub.
  void draw_object() {
    if (!report_.visible) return;
    const TallObject& object = *report_.query.object;
    const double right = frame_.box.xmax - 2, left = right - 5, foot = report_.stands_on.to_m;
    const auto up = [&](double height) { return frame_.y.at(foot + height); };
    const double from = report_.visible->from_m;
    drawing_.rectangle({left, up(from), right, up(0)}, kUnseen);
    drawing_.rectangle({left, up(object.tip_m), right, up(from)}, kChartSeen);
    if (object.hub_m) {
      const Point2 hub[] = {{left - 3, up(*object.hub_m)}, {right, up(*object.hub_m)}};
      drawing_.polyline(hub, {kReportInk, 0.8, {}});
    }
    if (from >= object.tip_m) return;
    const Point2 lowest[] = {at(0, report_.antennas.from_m), {left, up(from)}};
    drawing_.polyline(lowest, {kChartSeen, 0.9, {4, 2}});
  }

  /// Draws the critical point. Its label hangs from the top of the chart, clear of the ray, on a line down to the
  /// point.
  void draw_critical() {
    if (!report_.critical) return;
    const Point2 point = at(*report_.critical);
    const Lettering lettering{8.5, kMarker, Align::kLeft, false, 0};
    const std::string text =
        drawing_.fitted("Critical point, " + critical_line(report_), frame_.box.width() - 12, lettering);
    const double width = drawing_.text_width(text, lettering), y = frame_.box.ymin + 12;
    const double x = std::clamp(point.x - width / 2, frame_.box.xmin + 6, frame_.box.xmax - width - 6);
    const Point2 leader[] = {{std::clamp(point.x, x, x + width), y + 4}, point};
    drawing_.polyline(leader, {kMarker, 0.6, {2, 1.5}});
    drawing_.rectangle({x - 3, y - 9, x + width + 3, y + 4}, kWhite);
    drawing_.text({x, y}, text, lettering);
    drawing_.circle(point, 3.2, {1, 1, 1, 1});
    drawing_.circle(point, 2.4, kMarker);
  }

  void draw_key() {
    const double k = drop_ > 0 ? 1 / (2 * drop_ * report_.query.earth.radius) : 0;
    const std::string earth = drop_ > 0 ? fmt::format("Terrain over the effective Earth, K = {:.4g}", k)
                                        : std::string("Terrain over a flat Earth");
    std::vector<LegendItem> items = {{earth, {kChartGround, 1, {}}, true}, {"Ray", {kRay, 1.3, {}}, false}};
    if (wavelength_ > 0) {
      items.push_back({"First Fresnel zone, F1", {kZoneLine, 0.7, {}}, false});
      items.push_back({"0.6 F1", {kZoneLine, 0.6, {3, 2}}, false});
    }
    if (worst_k_ > 0) items.push_back({fmt::format("Terrain at K = {:.4g}", worst_k_), {kWorst, 0.9, {4, 2}}, false});
    if (bullington()) items.push_back({"Bullington's edge", kBullingtonLine, false});
    if (report_.losses && !report_.losses->deygout.empty()) items.push_back({"Deygout's edges", kDeygoutMark, false});
    if (report_.reflection && report_.reflection->ground_m)
      items.push_back(
          {"Reflected path, " + std::string(report_.reflection->screen ? "screened" : "clear"), kReflectedPath, false});
    for (const std::uint16_t theme : themes_)
      items.push_back({cause_of(report_, theme), {theme_colour(theme), 1, {}}, true});
    if (!report_.obstructions.empty()) items.push_back({"Above the ray", {kCut, 1, {}}, true});
    if (report_.visible) {
      items.push_back({"Object at B, seen", {kChartSeen, 1, {}}, true});
      items.push_back({"Object at B, hidden", {kUnseen, 1, {}}, true});
    }
    items.push_back({"Equal elevation", {kReportFaint, 0.8, {}}, false});
    draw_legend(drawing_, {frame_.box.xmin, frame_.box.ymax + 43}, frame_.box.width(), items);
  }

  Drawing& drawing_;
  const LosReport& report_;
  double length_, drop_, wavelength_;
  double worst_drop_ = 0, worst_k_ = 0;
  Profile dense_;
  Profile ground_;  ///< dense, too; without raised features
  ChartFrame frame_;
  std::set<std::uint16_t> themes_;
};

}  // namespace

void draw_sight_chart(Drawing& drawing, const Box& area, const LosReport& report) {
  SightChart(drawing, area, report).draw();
}

std::string sight_svg(const LosReport& report, double width, double height) {
  Drawing drawing(Drawing::Format::kSvg, width, height);
  draw_sight_chart(drawing, {0, 0, width, height}, report);
  return drawing.finish();
}

}  // namespace itin::profile
