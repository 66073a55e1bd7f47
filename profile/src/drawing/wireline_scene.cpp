#include "drawing/wireline_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <itin/azimuth.hpp>
#include <itin/degrees.hpp>
#include <itin/label_places.hpp>
#include <itin/simplified.hpp>

#include "drawing/palette.hpp"

namespace itin::profile {

namespace {

constexpr double kTellable = 0.06;    ///< points: a fiftieth of a millimetre
constexpr double kMeshDegrees = 1;    ///< between lines of the terrain's mesh that lead away from the eye
constexpr double kSteepestJoint = 4;  ///< a crest climbs no more from one line of sight to the next, angle over angle

// Half the width of a tower, by its height; and the outline of a blade, along it and across, by the rotor's radius.
// They are those of usual turbines, about.
constexpr double kTowerFoot = 0.022, kTowerHead = 0.014;
constexpr std::array<std::pair<double, double>, 6> kBlade{
    {{0, -0.018}, {0.08, -0.018}, {0.22, -0.045}, {1, -0.004}, {1, 0.006}, {0, 0.018}}};

double elevation_of(const WirelineQuery& query, const PlacedTurbine& placed, double height) {
  return apparent_angle_deg(query.earth, placed.distance, placed.turbine->ground_m + height - query.eye_elevation_m);
}

}  // namespace

std::vector<PlacedTurbine> placed_turbines(const WirelineQuery& query) {
  std::vector<PlacedTurbine> placed;
  for (const WirelineTurbine& t : query.turbines) {
    const double dx = t.position.x - query.eye.x, dy = t.position.y - query.eye.y, d = std::hypot(dx, dy);
    const double across = within_turn(in_degrees(std::atan2(dx, dy)) - query.from_deg);
    if (across > query.width_deg || d > query.reach_m || d == 0) continue;
    PlacedTurbine& p = placed.emplace_back(PlacedTurbine{&t, d, across, 0, 0});
    p.base = elevation_of(query, p, 0), p.top = elevation_of(query, p, t.tip_m);
  }
  std::stable_sort(placed.begin(), placed.end(),
                   [](const PlacedTurbine& a, const PlacedTurbine& b) { return a.distance > b.distance; });
  return placed;
}

void draw_farm_names(Drawing& drawing, const WirelineQuery& query, Point2 right_end, double size, double gap) {
  std::vector<std::pair<std::string, Rgba>> farms;
  for (const WirelineTurbine& t : query.turbines)
    if (std::none_of(farms.begin(), farms.end(), [&](const auto& farm) { return farm.first == t.farm; }))
      farms.emplace_back(t.farm, t.colour);
  if (std::all_of(farms.begin(), farms.end(), [&](const auto& farm) { return farm.second == farms[0].second; })) return;
  std::reverse(farms.begin(), farms.end());
  for (const auto& [farm, colour] : farms) {
    const Lettering lettering{.size = size, .colour = drawn(colour), .align = Align::kRight, .bold = true};
    const std::string name = farm.empty() ? "(no farm)" : farm;
    drawing.text(right_end, name, lettering);
    right_end.x -= drawing.text_width(name, lettering) + gap;
  }
}

WirelineScene::WirelineScene(const Wireline& view, const Box& frame, WirelineProjection projection, const Part& part)
    : view_(view), frame_(frame), at_(std::move(projection)), part_(part), turbines_(placed_turbines(view.query)) {
  std::erase_if(turbines_, [&](const PlacedTurbine& t) { return !within(t.across); });
}

/// Draws from the farthest to the nearest, so that nearer things cover farther ones.
void WirelineScene::draw(Drawing& drawing) const {
  drawing.clip(frame_);
  auto turbine = turbines_.begin();
  for (auto band = view_.bands.rbegin(); band != view_.bands.rend(); ++band) {
    // A turbine on a limit stands in front of the band behind it. Limits are at most a metre from turbines.
    for (; turbine != turbines_.end() && turbine->distance >= band->to_m - 0.5; ++turbine)
      draw_turbine(drawing, *turbine, false);
    draw_band(drawing, *band);
    const auto number = static_cast<std::size_t>(view_.bands.rend() - band) - 1;
    draw_mesh(drawing, number);
    draw_joints(drawing, number);
  }
  for (; turbine != turbines_.end(); ++turbine) draw_turbine(drawing, *turbine, false);
  if (view_.query.hidden_dashed)
    for (const PlacedTurbine& t : turbines_) draw_turbine(drawing, t, true);
  draw_labels(drawing);
  drawing.unclip();
}

void WirelineScene::draw_band(Drawing& drawing, const WirelineBand& band) const {
  const auto [begin, lines] = lines_within();
  for (std::size_t first = begin; first < lines;) {
    if (std::isnan(band.angle_deg[first])) {
      ++first;
      continue;
    }
    std::size_t last = first;
    while (last + 1 < lines && !std::isnan(band.angle_deg[last + 1])) ++last;
    draw_stretch(drawing, band, first, last);
    first = last + 1;
  }
}

/// Draws the mesh's lines that lead from a band towards the eye, as far as the next nearer band, which covers the rest.
void WirelineScene::draw_mesh(Drawing& drawing, std::size_t farther) const {
  if (farther == 0) return;
  const WirelineBand &far = view_.bands[farther], &near = view_.bands[farther - 1];
  const WirelineQuery& query = view_.query;
  const auto [begin, lines] = lines_within();
  const double first = query.from_deg + static_cast<double>(begin) * query.step_deg;
  for (double azimuth = std::ceil(first / kMeshDegrees) * kMeshDegrees;; azimuth += kMeshDegrees) {
    const auto line = static_cast<std::size_t>(std::lround((azimuth - query.from_deg) / query.step_deg));
    if (line >= lines) return;
    if (far.angle_deg[line] > near.angle_deg[line])
      drawing.polyline(std::array{place(line, far), place(line, near)}, mesh_stroke(far));
  }
}

/// Joins crests. A crest that goes on in another band ends in one band at a line of sight, and begins in the other at
/// the next.
void WirelineScene::draw_joints(Drawing& drawing, std::size_t nearer) const {
  const WirelineBand& band = view_.bands[nearer];
  const auto [begin, lines] = lines_within();
  const double most = kSteepestJoint * view_.query.step_deg;
  for (std::size_t i = begin; i + 1 < lines; ++i) {
    if (band.crest[i] == band.crest[i + 1]) continue;
    const std::size_t mine = band.crest[i] ? i : i + 1, other = band.crest[i] ? i + 1 : i;
    const auto goes_on = [&](const WirelineBand& farther) {
      return farther.crest[other] && !farther.crest[mine] &&
             std::abs(farther.angle_deg[other] - band.angle_deg[mine]) <= most;
    };
    const auto next =
        std::find_if(view_.bands.begin() + static_cast<std::ptrdiff_t>(nearer) + 1, view_.bands.end(), goes_on);
    if (next != view_.bands.end())
      drawing.polyline(std::array{place(mine, band), place(other, *next)}, stroke_of(band));
  }
}

Point2 WirelineScene::place(std::size_t line, const WirelineBand& band) const {
  return at_(std::min(static_cast<double>(line) * view_.query.step_deg, view_.query.width_deg), band.angle_deg[line]);
}

std::pair<std::size_t, std::size_t> WirelineScene::lines_within() const {
  const double step = view_.query.step_deg;
  return {static_cast<std::size_t>(std::max(0.0, std::floor(part_.from_deg / step))),
          std::min(view_.bands.front().angle_deg.size(), static_cast<std::size_t>(std::ceil(part_.to_deg / step)) + 1)};
}

void WirelineScene::draw_stretch(Drawing& drawing, const WirelineBand& band, std::size_t first,
                                 std::size_t last) const {
  const double below = frame_.ymax + 20;
  const auto at = [&](std::size_t i) {
    const Point2 p = place(i, band);
    return Point2{p.x, std::min(p.y, below - 1)};
  };
  std::vector<Point2> outline;
  for (std::size_t i = first; i <= last; ++i) outline.push_back(at(i));
  outline = simplified(outline, kTellable);
  outline.push_back({outline.back().x, below});
  outline.push_back({outline.front().x, below});
  drawing.polygon(outline, kPaper);
  drawing.polyline(std::span(outline).first(outline.size() - 2), mesh_stroke(band));
  const Stroke stroke = stroke_of(band);
  std::vector<Point2> crest;
  for (std::size_t i = first; i <= last; ++i) {
    if (band.crest[i]) crest.push_back(at(i));
    if (band.crest[i] && i < last) continue;
    if (crest.size() > 1) drawing.polyline(simplified(crest, kTellable), stroke);
    crest.clear();
  }
}

/// Makes farther bands fainter.
Stroke WirelineScene::stroke_of(const WirelineBand& band) const {
  const double far = std::log(band.to_m / 20) / std::log(view_.query.reach_m / 20);
  const double grey = 0.05 + 0.55 * std::clamp(far, 0.0, 1.0);
  return {{grey, grey, grey}, part_.weight * (1.1 - 0.6 * std::clamp(far, 0.0, 1.0)), {}};
}

Stroke WirelineScene::mesh_stroke(const WirelineBand& band) const {
  const double grey = 0.6 + 0.4 * stroke_of(band).colour.red;
  return {{grey, grey, grey}, 0.3 * part_.weight, {}};
}

void WirelineScene::draw_turbine(Drawing& drawing, const PlacedTurbine& placed, bool dashed) const {
  const WirelineTurbine& t = *placed.turbine;
  Stroke stroke{drawn(t.colour), 0.35 * part_.weight, {}};
  if (dashed) stroke.dashes = {1.5, 1.5};
  // The place of a point of the rotor's disc, or of the mast, metres to the right of the axis and above the ground.
  const auto point = [&](double right, double height) {
    return at_(placed.across + in_degrees(std::atan2(right, placed.distance)),
               elevation_of(view_.query, placed, height));
  };
  const auto draw_part = [&](const std::vector<Point2>& outline) {
    if (!dashed) drawing.polygon(outline, stroke.colour);
    std::vector<Point2> closed = outline;
    closed.push_back(outline.front());
    drawing.polyline(closed, stroke);
  };
  const bool has_rotor = t.hub_m && *t.hub_m < t.tip_m;
  const double hub = has_rotor ? *t.hub_m : t.tip_m, radius = t.tip_m - hub;
  draw_part({point(-kTowerFoot * hub, 0), point(kTowerFoot * hub, 0), point(kTowerHead * hub, hub),
             point(-kTowerHead * hub, hub)});
  if (!has_rotor) return;
  for (const double thirds : {0.0, 1.0, 2.0}) {
    const double turned = thirds * 2 * std::numbers::pi / 3 + in_radians(t.blade_deg);
    std::vector<Point2> blade;
    for (const auto& [along, aside] : kBlade)
      blade.push_back(point(radius * (along * std::sin(turned) + aside * std::cos(turned)),
                            hub + radius * (along * std::cos(turned) - aside * std::sin(turned))));
    draw_part(blade);
  }
  if (dashed) return;
  std::vector<Point2> circle;
  for (int i = 0; i <= 48; ++i) {
    const double angle = i * 2 * std::numbers::pi / 48;
    circle.push_back(point(radius * std::sin(angle), hub + radius * std::cos(angle)));
  }
  drawing.polyline(circle, {stroke.colour, 0.25 * part_.weight, {}});
}

/// Draws numbers above the tips seen, each as low as it can stand beside the others, with a line down to its tip.
void WirelineScene::draw_labels(Drawing& drawing) const {
  std::vector<const PlacedTurbine*> seen;
  for (const PlacedTurbine& t : turbines_)
    if (t.turbine->seen) seen.push_back(&t);
  std::sort(seen.begin(), seen.end(), [](const auto* a, const auto* b) { return a->across < b->across; });
  LabelPlaces places;
  for (const PlacedTurbine* t : seen) {
    const Lettering lettering{
        .size = part_.label_size, .colour = drawn(t->turbine->colour), .align = Align::kCentre, .rim = 1};
    const double half = drawing.text_width(t->turbine->label, lettering) / 2 + 1, row = 1.15 * lettering.size;
    const Point2 tip = at_(t->across, t->top);
    for (double y = tip.y - 4; y - row > frame_.ymin; y -= row) {
      const Box box{tip.x - half, y - row, tip.x + half, y + 1};
      if (!places.free(box)) continue;
      places.take(box);
      if (y < tip.y - 5) drawing.polyline(std::array{Point2{tip.x, y + 1}, tip}, {lettering.colour, 0.25, {}});
      drawing.text({tip.x, y}, t->turbine->label, lettering);
      break;
    }
  }
}

}  // namespace itin::profile
