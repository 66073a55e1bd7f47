#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <itin/building_outlines.hpp>
#include <itin/counted.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/sector_names.hpp>
#include <viewshed/zone_files.hpp>

namespace itin::viewshed {

namespace {

using ObjectSample = profile::SheetKey::Sample;

constexpr Rgba kBuilding{70, 60, 55, 255};

/// Returns one mark for those at one place, which are the sectors of a mast.
std::vector<profile::SheetMark> one_each_place(const std::vector<profile::SheetMark>& marks) {
  std::vector<profile::SheetMark> places;
  std::vector<std::vector<std::string>> names;
  std::map<std::pair<double, double>, std::size_t> number_of;
  for (const profile::SheetMark& mark : marks) {
    const auto [place, is_new] = number_of.try_emplace({mark.at.x, mark.at.y}, places.size());
    if (is_new) places.push_back({mark.at, ""}), names.emplace_back();
    if (!mark.label.empty()) names[place->second].push_back(mark.label);
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!names[i].empty()) places[i].label = names_together(names[i]);
  return places;
}

/// Returns what a map of hubs adds to the key of turbines of which some have no hub that is known.
std::string unknown_hubs(std::size_t unknown, std::size_t all) {
  if (unknown == 0) return "";
  return unknown == all ? ", of unknown hub height" : fmt::format(", {} of unknown hub height", unknown);
}

}  // namespace

MapObjects mast_objects(const std::vector<profile::SheetMark>& masts, std::string key) {
  return {{profile::SheetMarks{profile::SheetSymbol::kMast, kMastColour, one_each_place(masts)}},
          {{ObjectSample::kMark, {kMastColour}, std::move(key)}}};
}

bool is_named(const Observer& observer) {
  return observer.name.find_first_not_of("0123456789") != std::string::npos;
}

std::string counted_observers(const std::vector<Observer>& observers) {
  std::set<std::pair<double, double>> places;
  for (const Observer& observer : observers) places.insert({observer.position.x, observer.position.y});
  const std::string all = counted(observers.size(), "observer");
  return places.size() == observers.size() ? all : all + " at " + counted(places.size(), "place");
}

MapObjects observer_objects(const std::vector<Observer>& observers, const std::string& key) {
  std::vector<profile::SheetMark> marks;
  for (const Observer& observer : observers)
    marks.push_back({observer.position, observers.size() > 1 || is_named(observer) ? observer.name : ""});
  const char* const several = observers.size() == 1 ? "Observer" : "Observers";
  return mast_objects(marks, key.empty() ? several : key);
}

MapObjects turbine_objects(const std::vector<Turbine>& turbines, bool of_hubs) {
  MapObjects objects;
  for (const TurbineGroup& group : turbine_groups(turbines)) {
    profile::SheetMarks marks{profile::SheetSymbol::kTurbine, group.colour, {}};
    std::size_t unknown = 0;
    for (const std::size_t i : group.turbines) {
      marks.marks.push_back({turbines[i].position, fmt::format("{}", turbines[i].number)});
      if (!turbines[i].hub_height) ++unknown;
    }
    const std::string text = counted(marks.marks.size(), "wind turbine") + ", numbered" +
                             (of_hubs ? unknown_hubs(unknown, marks.marks.size()) : "");
    objects.keys.push_back({ObjectSample::kMark,
                            {marks.colour},
                            group.name.empty() ? text : fmt::format("{}: {}", group.name, text),
                            marks.symbol});
    objects.layers.emplace_back(std::move(marks));
  }
  return objects;
}

MapObjects building_objects(const Store& store, const ThemeChoice& themes, const Box& box) {
  const double pixel = std::max(box.width(), box.height()) / 1000;
  profile::SheetLines lines{{}, kBuilding, 0.2, false};
  for (auto& ring : building_outlines(store, themes, box, {0.1 * pixel, 2 * pixel}))
    lines.lines.push_back({std::move(ring), ""});
  if (lines.lines.empty()) return {};
  return {{std::move(lines)}, {{ObjectSample::kLine, {kBuilding}, "Building outline"}}};
}

}  // namespace itin::viewshed
