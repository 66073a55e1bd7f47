#include "workflows/dwellings/dwelling_facades.hpp"

#include <algorithm>
#include <cmath>

#include <itin/azimuth.hpp>

namespace itin::viewshed {

namespace {

/// Walls whose directions differ by less are one facade.
constexpr double kStraightDeg = 20;

/// A stretch of wall, its length, and where it looks.
struct FacadeStretch {
  const WallPlace* wall = nullptr;
  double length_m = 0, outward_deg = 0;
};

FacadeStretch measured(const WallPlace& wall) {
  FacadeStretch stretch{&wall};
  const auto side = [&](std::size_t i) {
    return Point2{wall.stretch[i].x - wall.stretch[i - 1].x, wall.stretch[i].y - wall.stretch[i - 1].y};
  };
  const auto length = [](Point2 v) { return std::hypot(v.x, v.y); };
  for (std::size_t i = 1; i < wall.stretch.size(); ++i) stretch.length_m += length(side(i));
  double left = stretch.length_m / 2;
  std::size_t middle = 1;
  while (middle + 1 < wall.stretch.size() && left > length(side(middle))) left -= length(side(middle++));
  // The wall looks to the left of its stretch.
  const Point2 along = side(middle);
  stretch.outward_deg = grid_azimuth_deg({0, 0}, {-along.y, along.x});
  return stretch;
}

bool go_on(const FacadeStretch& a, const FacadeStretch& b) {
  constexpr double kSamePlace = 0.001;
  const auto meet = [](const Point3& p, const Point3& q) { return std::hypot(p.x - q.x, p.y - q.y) < kSamePlace; };
  const double turn = std::abs(std::remainder(a.outward_deg - b.outward_deg, 360));
  return turn < kStraightDeg && (meet(a.wall->stretch.back(), b.wall->stretch.front()) ||
                                 meet(a.wall->stretch.front(), b.wall->stretch.back()));
}

DwellingFacade facade_of(const std::vector<FacadeStretch>& run) {
  const FacadeStretch& middle = run[run.size() / 2];
  DwellingFacade facade{middle.wall->position, middle.wall->ground_m, middle.outward_deg};
  for (const FacadeStretch& stretch : run) facade.length_m += stretch.length_m;
  return facade;
}

}  // namespace

std::vector<DwellingFacade> facades_of(const std::vector<WallPlace>& walls) {
  std::vector<std::vector<FacadeStretch>> runs;
  for (const WallPlace& wall : walls) {
    if (wall.least_m > 0) continue;
    const FacadeStretch stretch = measured(wall);
    const bool joins =
        !runs.empty() && go_on(runs.back().back(), stretch) &&
        std::abs(std::remainder(runs.back().front().outward_deg - stretch.outward_deg, 360)) < kStraightDeg;
    if (!joins) runs.emplace_back();
    runs.back().push_back(stretch);
  }
  // A ring may begin amid a facade.
  if (runs.size() > 1 && go_on(runs.back().back(), runs.front().front())) {
    runs.back().insert(runs.back().end(), runs.front().begin(), runs.front().end());
    runs.erase(runs.begin());
  }
  std::vector<DwellingFacade> facades;
  for (const std::vector<FacadeStretch>& run : runs) facades.push_back(facade_of(run));
  return facades;
}

}  // namespace itin::viewshed
