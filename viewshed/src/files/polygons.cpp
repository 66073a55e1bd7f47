#include <algorithm>
#include <limits>
#include <set>
#include <span>

#include <fmt/format.h>

#include <itin/raster_regions.hpp>
#include <viewshed/viewshed.hpp>

#include "line/verdicts.hpp"
#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

using RegionClasses = std::vector<RegionClass>;

RegionClasses region_classes_of_verdicts(bool certified) {
  const std::string certainly = certified ? "certainly " : "";
  return {{code_of(Verdict::kVisible), certainly + "visible"},
          {code_of(Verdict::kHidden), certainly + "hidden"},
          {code_of(Verdict::kUndecided), "undecided"}};
}

RegionClasses region_classes_of_zones() {
  return {{code_of(Verdict::kVisible), "in sight, zone clear"},
          {code_of(Verdict::kZoneCut), "in sight, zone cut"},
          {code_of(Verdict::kHidden), "hidden"},
          {code_of(Verdict::kUndecided), "undecided"}};
}

RegionClasses classes_of_counts(const Result& result) {
  const std::set<std::uint16_t> counts(result.count.begin(), result.count.end());
  RegionClasses classes;
  for (const std::uint16_t count : counts)
    if (count != kCountOutside)
      classes.push_back({count, count == 0   ? std::string("hidden")
                                : count == 1 ? std::string("1 observer")
                                             : fmt::format("{} observers", count)});
  return classes;
}

RegionClasses classes_of_observers(const Result& result) {
  RegionClasses classes;
  for (std::uint32_t i = 0; i < result.request.observers.size(); ++i) {
    const std::string& name = result.request.observers[i].name;
    classes.push_back({i + 1, name.empty() ? fmt::format("observer {}", i + 1) : name});
  }
  return classes;
}

RegionClasses classes_of_blockers(const Result& result) {
  const std::set<std::uint32_t> themes(result.blocker_theme.begin(), result.blocker_theme.end());
  RegionClasses classes;
  for (const std::uint32_t theme : themes) {
    if (theme == kNoBlocker) continue;
    classes.push_back({theme, theme == 0                           ? std::string("terrain")
                              : theme == kMissingGround            ? std::string("no data")
                              : theme <= result.theme_names.size() ? result.theme_names[theme - 1]
                                                                   : fmt::format("theme {}", theme)});
  }
  return classes;
}

}  // namespace

void write_polygons(const std::string& path, const Result& result, const std::string& crs_wkt, bool overwrite,
                    std::span<const std::uint8_t> no_data) {
  RegionDescription description{crs_wkt, "viewshed", {}, overwrite};
  const auto write = [&](const auto& codes, RegionClasses classes) {
    using Code = std::remove_cv_t<typename decltype(std::span(codes))::element_type>;
    // No class has this value: the greatest few are taken.
    constexpr Code kNoData = std::numeric_limits<Code>::max() - 3;
    std::span<const Code> values(codes);
    std::vector<Code> marked;
    if (!no_data.empty()) {
      marked.assign(codes.begin(), codes.end());
      for (std::size_t i = 0; i < no_data.size(); ++i)
        if (no_data[i] == 1) marked[i] = kNoData;
      values = marked;
    }
    description.classes = std::move(classes);
    for (std::size_t i = 0; i < description.classes.size() && description.classes.size() > 1; ++i) {
      RegionClass& c = description.classes[i];
      set_distinct_colour(i, c.red, c.green, c.blue);
    }
    if (!no_data.empty()) description.classes.push_back({kNoData, "no ground data", 160, 160, 160});
    write_regions(path, result.grid, values, description);
  };
  switch (result.request.mode) {
    case Mode::kCount:
      return write(result.count, classes_of_counts(result));
    case Mode::kNearest:
      return write(result.nearest, classes_of_observers(result));
    case Mode::kBlocker:
      return write(result.blocker_theme, classes_of_blockers(result));
    case Mode::kFresnel:
      return write(codes_of(result.visible), region_classes_of_zones());
    case Mode::kVisible:
    case Mode::kWhich:
    case Mode::kAngle:
    case Mode::kHeight:
    case Mode::kProbability:
    case Mode::kLoss:
      return write(codes_of(result.visible), region_classes_of_verdicts(result.certified));
  }
}

}  // namespace itin::viewshed
