#include "site/site_links.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <itin/cross_section.hpp>
#include <itin/parallel.hpp>
#include <itin/same_place.hpp>
#include <itin/triangulate.hpp>
#include <profile/fresnel.hpp>
#include <profile/los.hpp>

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

/// Judges many links as `itin los` does. Keeps the tiles of the surface that it has triangulated.
class LinkJudge {
 public:
  LinkJudge(const Store& store, const SiteOptions& options)
      : options_(options), surface_(store, Detail::tolerance(0), options.themes.choice(), cache(options)) {
    if (options.themes.choice().includes_standing(store.metadata().themes))
      ground_.emplace(store, Detail::tolerance(0), ThemeChoice::none(), cache(options));
    query_.earth = options.earth.earth();
    query_.from_on_surface = query_.to_on_surface = options.on_surface;
    query_.gaps_block = options.nodata == viewshed::NoData::kBlock;
  }

  bool clear(const SiteStand& a, const SiteStand& b) const {
    const profile::Profile line = profile::from_section(surface_.between(a.position, b.position));
    if (const auto criterion = options_.criterion()) {
      const auto zone =
          profile::fresnel_clearance(line, {a.elevation(), b.elevation()}, query_.earth, criterion->wavelength);
      if (zone && zone->fraction < criterion->fraction) return false;
    }
    profile::LosQuery query = query_;
    query.from_height_m = a.height, query.to_height_m = b.height;
    profile::Profile ground;
    if (ground_) ground = profile::from_section(ground_->between(a.position, b.position));
    return profile::analyse(line, query, std::move(ground)).verdict != profile::SightVerdict::kHidden;
  }

 private:
  static SectionSurface::Options cache(const SiteOptions& options) {
    return {std::min(SectionSurface::Options().cache_bytes, options.memory_bytes / 8)};
  }

  const SiteOptions& options_;
  profile::LosQuery query_;
  SectionSurface surface_;
  std::optional<SectionSurface> ground_;  ///< under standing features
};

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
  const auto linked = [&progress, judge = std::make_shared<const LinkJudge>(store, options),
                       stands = std::move(stands)](std::size_t site, std::span<const std::size_t> others) {
    std::vector<char> clear(others.size());
    parallel_for(others.size(), [&](std::size_t i) {
      progress.throw_if_cancelled();
      clear[i] = judge->clear(stands[site], stands[others[i]]);
    });
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < others.size(); ++i)
      if (clear[i]) result.push_back(others[i]);
    return result;
  };
  return std::make_shared<viewshed::LinkNetwork>(inputs.options.size(), standing, last, linked);
}

}  // namespace itin::cli
