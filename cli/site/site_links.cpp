#include "site/site_links.hpp"

#include <cmath>
#include <utility>

#include <itin/cross_section.hpp>
#include <itin/same_place.hpp>
#include <itin/triangulate.hpp>
#include <profile/links.hpp>

#include "options/radio_options.hpp"

namespace itin::cli {

namespace {

using viewshed::SiteStand;

profile::SightLine line_between(const Store& store, const SiteOptions& options, const SiteStand& a, const SiteStand& b,
                                Progress& progress) {
  const auto criterion = options.criterion();
  const Window window = Window::corridor(a.position, b.position, 4 * store.metadata().grid.resolution);
  const Tin tin = triangulate(store, window, Detail::tolerance(0), progress, options.themes.choice());
  return profile::SightLines(tin, options.earth.earth(),
                             criterion ? std::optional(criterion->wavelength) : std::nullopt)
      .between({a.position.x, a.position.y, a.elevation()}, {b.position.x, b.position.y, b.elevation()});
}

SiteLink link_between(const Store& store, const SiteOptions& options, const SiteStand& a, const SiteStand& b,
                      Progress& progress) {
  SiteLink link;
  link.from = a, link.to = b;
  link.distance_m = std::hypot(a.position.x - b.position.x, a.position.y - b.position.y);
  bool is_blocked = false;
  if (!same_place(store.metadata().grid, a.position, b.position)) {
    link.line = line_between(store, options, a, b, progress);
    is_blocked = options.nodata == viewshed::NoData::kBlock &&
                 !cross_section(store, a.position, b.position, Detail::tolerance(0)).gaps.empty();
  }
  link.visible = link.line.visible() && !is_blocked;
  link.clear = link.visible && link.line.clears(options.frequency_ghz ? options.fresnel : 0);
  return link;
}

/// The question that `itin los --links` would be asked.
profile::LinkQuery link_query(const SiteOptions& options) {
  profile::LinkQuery query;
  query.earth = options.earth.earth();
  query.themes = options.themes.choice();
  query.from_on_surface = query.to_on_surface = options.on_surface;
  query.gaps_block = options.nodata == viewshed::NoData::kBlock;
  if (options.frequency_ghz) {
    query.radio.emplace();
    query.radio->frequency_ghz = *options.frequency_ghz;
    query.radio->effective_earth_km = effective_earth_km(query.earth);
  }
  return query;
}

}  // namespace

std::vector<SiteLink> site_links(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                                 const viewshed::Choice& choice, const std::optional<SiteStand>& hub,
                                 Progress& progress) {
  std::vector<SiteStand> ends;
  for (const viewshed::ChosenSite& site : choice.chosen) ends.push_back(inputs.stands[site.option]);
  for (std::size_t i = inputs.options.size(); i < inputs.stands.size() && options.intervisible; ++i) {
    ends.push_back(inputs.stands[i]);
    ends.back().name = "existing " + ends.back().name;
  }
  if (hub) ends.push_back(*hub);
  std::vector<SiteLink> result;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size(); ++j)
      result.push_back(link_between(store, options, ends[i], ends[j], progress));
    progress.report("links", static_cast<double>(i + 1) / static_cast<double>(ends.size()));
  }
  return result;
}

std::shared_ptr<viewshed::LinkNetwork> link_network(const Store& store, const SiteOptions& options,
                                                    const SiteInputs& inputs, const std::optional<SiteStand>& hub,
                                                    Progress& progress) {
  std::vector<SiteStand> stands = inputs.stands;
  if (hub) stands.push_back(*hub);
  const std::size_t standing = stands.size() - inputs.options.size();
  const auto last = hub ? std::optional(stands.size() - 1) : std::nullopt;
  const auto linked = [&store, &progress, query = link_query(options), fraction = options.fresnel,
                       stands = std::move(stands)](std::size_t site, std::span<const std::size_t> others) {
    std::vector<profile::Link> links;
    const SiteStand& from = stands[site];
    for (const std::size_t other : others)
      links.push_back({{}, from.position, from.height, stands[other].position, stands[other].height});
    const std::vector<profile::LinkResult> rows = profile::survey_links(store, links, query, progress);
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i].verdict && *rows[i].verdict != profile::SightVerdict::kHidden &&
          (!rows[i].fresnel_fraction || *rows[i].fresnel_fraction >= fraction))
        result.push_back(others[i]);
    return result;
  };
  return std::make_shared<viewshed::LinkNetwork>(inputs.options.size(), standing, last, linked);
}

}  // namespace itin::cli
