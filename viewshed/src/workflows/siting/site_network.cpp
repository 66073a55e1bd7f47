#include "workflows/siting/site_network.hpp"

#include <utility>

#include <itin/memory_shares.hpp>
#include <itin/parallel.hpp>
#include <viewshed/site_links.hpp>

#include "workflows/siting/link_judge.hpp"

namespace itin::viewshed {

LinkRules link_rules(const SitePlanRequest& request) {
  LinkRules rules{{.earth = request.earth,
                   .themes = request.themes,
                   .from_on_surface = request.on_surface,
                   .to_on_surface = request.on_surface,
                   .nodata = request.nodata},
                  request.fresnel};
  if (request.frequency_ghz) {
    rules.query.radio.emplace().frequency_ghz = *request.frequency_ghz;
    rules.query.radio->effective_earth_km = effective_earth_km(request.earth);
  }
  return rules;
}

profile::Link link_between(const SitePosition& from, const SitePosition& to) {
  return {{}, from.position, from.height, to.position, to.height};
}

const char* outcome_of(const SitePlanRequest& request, const SiteLink& link) {
  const profile::SightVerdict verdict = link.found().verdict;
  if (verdict != profile::SightVerdict::kVisible || !request.frequency_ghz) return name_of(verdict);
  return link_rules(request).met_by(link.found()) ? "clear" : "in sight, zone cut";
}

SiteNetwork site_network(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                         const Choice& choice, const std::optional<SitePosition>& hub, Progress& progress) {
  using enum LinkEnd::Kind;
  SiteNetwork network;
  std::vector<LinkEnd>& ends = network.ends;
  for (const ChosenSite& site : choice.chosen) ends.push_back({kChosen, inputs.positions[site.option]});
  for (std::size_t i = inputs.options.size(); i < inputs.positions.size(); ++i) {
    ends.push_back({kExisting, inputs.positions[i]});
    ends.back().place.name = "existing " + ends.back().place.name;
  }
  if (hub) ends.push_back({kHub, *hub});
  if (request.turbines) return network;  // turbines need not see each other
  const profile::LinkQuery query = link_rules(request).query;
  const std::size_t linked = request.has_links() ? ends.size() : choice.chosen.size();
  for (std::size_t i = 0; i < linked; ++i) {
    for (std::size_t j = i + 1; j < linked; ++j) {
      progress.throw_if_cancelled();
      network.links.push_back({i, j, survey_link(store, link_between(ends[i].place, ends[j].place), query)});
    }
    progress.report("links", static_cast<double>(i + 1) / static_cast<double>(linked));
  }
  return network;
}

std::shared_ptr<LinkNetwork> link_network(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                                          const std::optional<SitePosition>& hub, Progress& progress) {
  std::vector<SitePosition> positions = inputs.positions;
  if (hub) positions.push_back(*hub);
  const std::size_t existing = positions.size() - inputs.options.size();
  const auto last = hub ? std::optional(positions.size() - 1) : std::nullopt;
  const SectionSurface::Options cache = section_cache_within(request.memory_bytes);
  const auto linked = [&progress, judge = std::make_shared<const LinkJudge>(store, link_rules(request), cache),
                       positions = std::move(positions)](std::size_t site, std::span<const std::size_t> others) {
    std::vector<char> clear(others.size());
    parallel_for(others.size(), [&](std::size_t i) {
      progress.throw_if_cancelled();
      clear[i] = judge->linked(positions[site], positions[others[i]]);
    });
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < others.size(); ++i)
      if (clear[i]) result.push_back(others[i]);
    return result;
  };
  return std::make_shared<LinkNetwork>(inputs.options.size(), existing, last, linked);
}

}  // namespace itin::viewshed
