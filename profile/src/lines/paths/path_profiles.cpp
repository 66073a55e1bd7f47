// Follows a path corner by corner.
#include <algorithm>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/leaf_areas.hpp>
#include <profile/path_profiles.hpp>

#include "lines/paths/foliage_on_path.hpp"

namespace itin::profile {

namespace {

/// Appends the part of the path beyond a corner; the corner itself is in `whole` already.
void append_part(Profile& whole, const Profile& part) {
  for (const ProfilePoint& p : part.points) {
    ProfilePoint moved = p;
    moved.distance_m += whole.length_m;
    if (!whole.points.empty()) {
      const ProfilePoint& last = whole.points.back();
      if (last.distance_m == moved.distance_m && last.ground_m == moved.ground_m) continue;
    }
    whole.points.push_back(moved);
  }
  for (const auto& [from, to] : part.gaps) {
    const double begin = from + whole.length_m, end = to + whole.length_m;
    if (!whole.gaps.empty() && from == 0 && whole.gaps.back().second == begin) {
      whole.gaps.back().second = end;
    } else {
      whole.gaps.emplace_back(begin, end);
    }
  }
  whole.length_m += part.length_m;
}

Profile along(const Store& store, const Detail& detail, const ThemeChoice& themes, PathProfiles& all,
              Progress& progress) {
  const std::vector<Point2>& corners = all.query.corners;
  Profile whole;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const CrossSection section = cross_section(store, corners[i], corners[i + 1], detail, themes, progress);
    append_part(whole, from_section(section));
    all.statistics += section.statistics;
    all.triangles += section.triangles;
  }
  return whole;
}

std::string name_of(const Detail& detail) {
  const double tolerance = detail.coarsest();
  return tolerance == 0 ? "every stored point" : fmt::format("tolerance {:g} m", tolerance);
}

void require_complete(const PathQuery& query) {
  if (query.corners.size() < 2) throw InputError("`corners`: a path has at least two", "corners");
  if (query.details.empty()) throw InputError("`details`: give at least one", "details");
  if (!query.names.empty() && query.names.size() != query.details.size())
    throw InputError("`names`: give one for each of `details`, or none", "names");
}

}  // namespace

PathProfiles profiles_along(const Store& store, const PathQuery& query, Progress& progress) {
  require_complete(query);
  PathProfiles all{query, {}, {}, {}, 0, store.path(), store.metadata()};
  std::optional<LeafAreas> leaves;
  if (query.foliage) leaves.emplace(store, query.themes, *query.foliage);
  for (std::size_t i = 0; i < query.details.size(); ++i) {
    const Detail& detail = query.details[i];
    const std::string name = query.names.empty() ? name_of(detail) : query.names[i];
    all.profiles.push_back({detail, name, along(store, detail, query.themes, all, progress)});
    if (leaves) all.profiles.back().foliage = foliage_on_path(all.profiles.back().profile, *leaves);
  }
  if (query.with_ground && query.themes.includes_raised(all.metadata.themes))
    all.ground = along(store, query.details.front(), ThemeChoice::none(), all, progress);
  return all;
}

}  // namespace itin::profile
