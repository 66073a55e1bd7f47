#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include <fmt/format.h>

#include <itin/raster_regions.hpp>
#include <viewshed/result.hpp>
#include <viewshed/result_files.hpp>

#include "files/verdict_classes.hpp"
#include "line/verdicts.hpp"
#include "modes/feature_names.hpp"
#include "request/request.hpp"
#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

using RegionClasses = std::vector<RegionClass>;

RegionClasses regions_of_verdicts(const Result& result) {
  RegionClasses classes;
  for (const RasterClass& c : verdict_classes(result)) classes.push_back({static_cast<std::uint32_t>(c.value), c.name});
  return classes;
}

RegionClasses classes_of_counts(const Result& result) {
  const auto& counted = result.get<Counts>().count;
  const std::set<std::uint16_t> counts(counted.begin(), counted.end());
  // Counts are of observers that certainly see the cell.
  const std::string none = result.cells.undecided > 0 ? "hidden or undecided" : "hidden";
  RegionClasses classes;
  for (const std::uint16_t count : counts)
    if (count != kCountOutside)
      classes.push_back({count, count == 0   ? none
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
  const auto& blockers = result.get<Blockers>().theme;
  const std::set<std::uint32_t> themes(blockers.begin(), blockers.end());
  RegionClasses classes;
  for (const std::uint32_t theme : themes)
    if (theme != kNoBlocker) classes.push_back({theme, blocker_name(result, theme)});
  return classes;
}

/// The band of each cell in view, from 1; 0 where its value is not known.
std::vector<std::uint8_t> codes_of_bands(const Result& result, const std::vector<float>& values,
                                         const std::vector<ValueBand>& bands) {
  std::vector<std::uint8_t> codes(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (result.visible[i] == Verdict::kOutside) codes[i] = code_of(Verdict::kOutside);
    if (!std::isnan(values[i])) codes[i] = static_cast<std::uint8_t>(band_of(bands, values[i]) + 1);
  }
  return codes;
}

/// The strongest come first, the unknown last.
RegionClasses classes_of_levels(const std::vector<ValueBand>& bands) {
  RegionClasses classes;
  for (std::size_t i = bands.size(); i-- > 0;)
    classes.push_back({static_cast<std::uint32_t>(i + 1), bands[i].label, bands[i].colour});
  classes.push_back({0, "level not known", kUndecidedGrey});
  return classes;
}

/// The least losses come first, the unknown last.
RegionClasses classes_of_losses(const std::vector<ValueBand>& bands) {
  RegionClasses classes;
  for (std::size_t i = 0; i < bands.size(); ++i)
    classes.push_back({static_cast<std::uint32_t>(i + 1), bands[i].label, bands[i].colour});
  classes.push_back({0, "loss not known", kUndecidedGrey});
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
    const bool ordered = studies_paths(result.request);
    for (std::size_t i = 0; i < description.classes.size() && description.classes.size() > 1 && !ordered; ++i)
      description.classes[i].colour = distinct_colour(i);
    if (!no_data.empty()) description.classes.push_back({kNoData, "no ground data", {160, 160, 160}});
    write_regions(path, result.grid, values, description);
  };
  switch (result.request.mode) {
    case Mode::kCount:
      return write(result.get<Counts>().count, classes_of_counts(result));
    case Mode::kNearest:
      return write(result.get<NearestObservers>().number, classes_of_observers(result));
    case Mode::kBlocker:
      return write(result.get<Blockers>().theme, classes_of_blockers(result));
    case Mode::kLevel: {
      const std::vector<ValueBand> bands = level_bands(result.request);
      return write(codes_of_bands(result, result.get<Levels>().level_dbm, bands), classes_of_levels(bands));
    }
    case Mode::kLoss: {
      const std::vector<ValueBand> bands = loss_bands();
      return write(codes_of_bands(result, result.get<Losses>().diffraction_db, bands), classes_of_losses(bands));
    }
    case Mode::kFresnel:
    case Mode::kVisible:
    case Mode::kWhich:
    case Mode::kAngle:
    case Mode::kHeight:
    case Mode::kProbability:
      return write(codes_of(result.visible), regions_of_verdicts(result));
  }
}

}  // namespace itin::viewshed
