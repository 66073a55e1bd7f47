#include "site/site_warnings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <viewshed/hidden_eyes.hpp>

#include "output/store_document.hpp"

namespace itin::cli {

namespace {

constexpr std::size_t kMostWarnings = 20;

void warn_of_left_out(const SiteResult& site, std::vector<std::string>& warnings) {
  const std::string all = site.options.path("site.json");
  std::vector<std::string> lines = site.inputs.rejected;
  // The caller does not know proposed candidates: it is enough to say how many were left out.
  for (std::size_t i = site.options.search_area.empty() ? 0 : site.inputs.barred.size(); i-- > 0;) {
    const Barred& barred = site.inputs.barred[i];
    const auto first = lines.begin() + static_cast<std::ptrdiff_t>(barred.first);
    *first = fmt::format("{}, each of which {}; all are listed in {}", counted(barred.count, "proposed candidate"),
                         barred.why, all);
    lines.erase(first + 1, first + static_cast<std::ptrdiff_t>(barred.count));
  }
  for (std::size_t i = 0; i < std::min(lines.size(), kMostWarnings); ++i) warnings.push_back("left out: " + lines[i]);
  if (lines.size() > kMostWarnings)
    warnings.push_back(fmt::format("left out: {} more; all are listed in {}", lines.size() - kMostWarnings, all));
}

/// Warns where the radius reaches beyond the data, since demand there is not counted.
void warn_of_reach(const SiteResult& site, const StoreMetadata& metadata, std::vector<std::string>& warnings) {
  const Box data = metadata.grid.box(metadata.bounds);
  const std::vector<viewshed::SitePosition>& places = site.inputs.positions;
  const auto beyond = std::count_if(places.begin(), places.end(), [&](const viewshed::SitePosition& place) {
    const Point2 p = place.position;
    return std::min({p.x - data.xmin, data.xmax - p.x, p.y - data.ymin, data.ymax - p.y}) < site.options.radius;
  });
  if (beyond == 0) return;
  warnings.push_back(
      fmt::format("the radius of {:g} m reaches beyond the data from {} of {}: demand there is not counted, so that "
                  "places near the edge of the data seem less seen than they are; import a larger source, or give a "
                  "smaller --radius",
                  site.options.radius, grouped(static_cast<std::uint64_t>(beyond)), counted(places.size(), "place")));
}

void warn_of_too_few(const SiteResult& site, std::vector<std::string>& warnings) {
  const SiteOptions& options = site.options;
  const bool short_of_share = options.share && site.inputs.demand.in_metric(site.choice.value + site.choice.existing) <
                                                   *options.share * site.inputs.demand.in_metric(site.inputs.total);
  const bool share_reached = options.share && !short_of_share;
  if (options.count && site.choice.chosen.size() < *options.count && !share_reached)
    warnings.push_back(fmt::format("{} chosen, not {}: no other site that may be chosen serves anything more",
                                   counted(site.choice.chosen.size(), "site"), *options.count));
  const std::size_t serving = site.choice.chosen.size() + site.inputs.existing();
  if (options.cover > 1 && serving < static_cast<std::size_t>(options.cover))
    warnings.push_back(fmt::format("nothing counts as served: --k-cover asks for {} sites, and there {} {}",
                                   options.cover, serving == 1 ? "is" : "are", serving));
  if (options.budget && site.choice.chosen.empty())
    warnings.emplace_back("nothing is chosen: no site that serves anything costs as little as --budget");
  if (short_of_share)
    warnings.emplace_back(
        "the share asked for is not reached: no further site that may be chosen serves anything more");
}

void warn_of_hidden_sites(const Store& store, const SiteResult& site, std::vector<std::string>& warnings) {
  if (site.options.on_surface) return;
  viewshed::Eyes eyes{"site", {}, Detail::tolerance(0), site.options.themes.choice()};
  for (const viewshed::SitePosition& p : site.inputs.positions)
    eyes.places.push_back({p.position.x, p.position.y, p.elevation()});
  viewshed::warn_of_hidden_eyes(store, eyes, warnings);
}

}  // namespace

void warn_of(const SiteResult& site, const Store& store, std::vector<std::string>& warnings) {
  const SiteOptions& options = site.options;
  if (options.frequency_ghz) options.earth.warn_of_light(warnings);
  warnings.insert(warnings.end(), site.inputs.warnings.begin(), site.inputs.warnings.end());
  warn_of_left_out(site, warnings);
  if (options.placement.given() && options.demand == "cells") warn_of_reach(site, store.metadata(), warnings);
  warn_of_hidden_sites(store, site, warnings);
  if (site.inputs.demand_without_ground > 0)
    warnings.push_back(fmt::format("{} of the demand cannot be served: there is no ground data",
                                   counted(site.inputs.demand_without_ground, "point")));
  warn_of_too_few(site, warnings);
}

}  // namespace itin::cli
