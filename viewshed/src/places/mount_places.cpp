#include "places/mount_places.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <itin/grid_units.hpp>
#include <itin/in_ring.hpp>

namespace itin::viewshed {

namespace {

/// How far beyond the wall offset the height of a wall is taken, so that footprints that were moved to the grid have
/// their full height there.
constexpr double kBehindWall = 0.05;

Point2 in_millimetres(Point2 p) {
  return {std::round(p.x * 1000) / 1000, std::round(p.y * 1000) / 1000};
}

/// A closed ring by the distance along it.
class RingWalk {
 public:
  explicit RingWalk(const std::vector<Point2>& ring) : ring_(ring), along_{0} {
    for (std::size_t i = 1; i < ring.size(); ++i)
      along_.push_back(along_.back() + std::hypot(ring[i].x - ring[i - 1].x, ring[i].y - ring[i - 1].y));
  }

  double length() const { return along_.back(); }

  /// A place of the ring, and the direction in which the ring runs there.
  struct Step {
    Point2 at, direction;
  };
  /// Precondition: the length is not 0, and the distance is no greater.
  Step at(double distance) const {
    const std::size_t i = side_at(distance);
    const double side = along_[i + 1] - along_[i], t = std::clamp((distance - along_[i]) / side, 0.0, 1.0);
    const Point2 way{ring_[i + 1].x - ring_[i].x, ring_[i + 1].y - ring_[i].y};
    return {{ring_[i].x + t * way.x, ring_[i].y + t * way.y}, {way.x / side, way.y / side}};
  }

  /// The ring from one distance to another, with its corners between.
  std::vector<Point2> stretch(double from, double to) const {
    std::vector<Point2> points{at(from).at};
    for (std::size_t i = side_at(from) + 1; i < along_.size() && along_[i] < to; ++i) points.push_back(ring_[i]);
    points.push_back(at(to).at);
    return points;
  }

 private:
  /// The side on which a distance lies: never one without length.
  std::size_t side_at(double distance) const {
    const auto next = std::upper_bound(along_.begin(), along_.end(), distance);
    if (next != along_.end()) return static_cast<std::size_t>(next - along_.begin()) - 1;
    const auto last = std::lower_bound(along_.begin(), along_.end(), along_.back());
    return static_cast<std::size_t>(last - along_.begin()) - 1;
  }

  const std::vector<Point2>& ring_;
  std::vector<double> along_;  ///< the distance of each corner
};

class PlaceFinder {
 public:
  PlaceFinder(const StandingBuilding& building, const Progress& progress)
      : foot_(building.foot),
        surface_(building.surface),
        ground_(building.ground),
        rules_(building.rules),
        progress_(progress) {}

  void walk_rings() {
    for (const std::vector<Point2>& ring : foot_.rings) walk(ring);
  }

  void lay_roof() {
    const Box box = box_of_rings(foot_.rings);
    const auto first = [&](double low) { return std::floor(low / rules_.spacing) + 0.5; };
    for (double row = first(box.ymin); row * rules_.spacing <= box.ymax; ++row)
      for (double column = first(box.xmin); column * rules_.spacing <= box.xmax; ++column)
        add_roof(in_millimetres({column * rules_.spacing, row * rules_.spacing}));
  }

  MountPlaces places() && { return std::move(places_); }

 private:
  void walk(const std::vector<Point2>& ring) {
    const RingWalk along(ring);
    if (!(along.length() > 0)) return;
    const double count = std::max(1.0, std::round(along.length() / rules_.spacing)), step = along.length() / count;
    for (double i = 0; i < count; ++i) {
      progress_.throw_if_cancelled();
      const RingWalk::Step middle = along.at((i + 0.5) * step);
      for (const double side : {1, -1}) {
        auto wall = wall_beside(middle, side);
        if (!wall) continue;
        std::vector<Point2> stretch = along.stretch(i * step, std::min((i + 1) * step, along.length()));
        if (side < 0) std::reverse(stretch.begin(), stretch.end());
        for (const Point2& p : stretch) wall->stretch.push_back({p.x, p.y, foot_at(*wall, p)});
        add_street(*wall, aside_of(middle, side, rules_.setback.value_or(0)));
        places_.walls.push_back(std::move(*wall));
        break;
      }
    }
  }

  /// The elevation of a wall's foot at a place of its stretch.
  double foot_at(const WallPlace& wall, Point2 place) const {
    if (wall.least_m > 0) return wall.ground_m + wall.least_m;
    return ground_.height(place).value_or(wall.ground_m);
  }

  void add_street(const WallPlace& wall, Point2 before) {
    const Point2 place = in_millimetres(before);
    if (!rules_.setback || wall.least_m > 0 || rules_.of_buildings[surface_.theme(place)]) return;
    if (const auto ground = ground_.height(place)) places_.street.push_back({place.x, place.y, *ground});
  }

  /// The place so far to the left of the ring (side 1), or to its right (-1).
  static Point2 aside_of(const RingWalk::Step& step, double side, double metres) {
    return {step.at.x - side * metres * step.direction.y, step.at.y + side * metres * step.direction.x};
  }

  /// Returns the wall that looks to that side of the ring.
  std::optional<WallPlace> wall_beside(const RingWalk::Step& step, double side) const {
    const Point2 before = in_millimetres(aside_of(step, side, rules_.reveal)),
                 behind = aside_of(step, -side, rules_.wall_offset + kBehindWall);
    if (!in_rings(foot_.rings, behind)) return std::nullopt;
    const auto top = surface_.height(behind), ground = ground_.height(before), foot = foot_of_wall(before);
    if (!top || !ground || !foot || *top - *foot <= kLeastWall) return std::nullopt;
    return WallPlace{.stretch = {},
                     .position = before,
                     .ground_m = *ground,
                     .least_m = std::max(0.0, *foot - *ground),
                     .most_m = *top - *ground,
                     .mast = {}};
  }

  /// Walls stand on the ground or on other buildings, but not on trees.
  std::optional<double> foot_of_wall(Point2 before) const {
    return rules_.of_buildings[surface_.theme(before)] ? surface_.height(before) : ground_.height(before);
  }

  void add_roof(Point2 place) {
    progress_.throw_if_cancelled();
    if (!in_rings(foot_.rings, place) || surface_.theme(place) != foot_.theme) return;
    if (const auto roof = surface_.height(place)) places_.roof.push_back({.position = place, .roof_m = *roof});
  }

  const BuildingFoot& foot_;
  const PlacedSurface &surface_, &ground_;
  const MountRules& rules_;
  const Progress& progress_;
  MountPlaces places_;
};

}  // namespace

std::optional<double> PlacedSurface::height(Point2 position) const {
  const auto units = pyramid->height_at(place_in_units(tin.grid, position));
  return units ? std::optional(*units * tin.grid.resolution) : std::nullopt;
}

std::uint16_t PlacedSurface::theme(Point2 position) const {
  const auto triangle = pyramid->triangle_at(place_in_units(tin.grid, position));
  return triangle ? tin.theme(tin.triangles[*triangle]) : std::uint16_t{0};
}

MountPlaces mount_places(const StandingBuilding& building, const Progress& progress) {
  PlaceFinder finder(building, progress);
  finder.walk_rings();
  finder.lay_roof();
  return std::move(finder).places();
}

std::vector<WallPlace> wall_places(const StandingBuilding& building, const Progress& progress) {
  PlaceFinder finder(building, progress);
  finder.walk_rings();
  return std::move(finder).places().walls;
}

std::vector<double> mount_heights(const WallPlace& wall, double storey) {
  std::vector<double> heights;
  for (double i = std::floor(wall.least_m / storey) + 1; i * storey <= wall.most_m; ++i) heights.push_back(i * storey);
  if (heights.empty()) heights.push_back(std::floor(wall.most_m * 100) / 100);
  return heights;
}

}  // namespace itin::viewshed
