#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/store.hpp>
#include <profile/clearance_error.hpp>
#include <profile/links.hpp>
#include <profile/profile.hpp>

#include "lines/findings.hpp"
#include "lines/links/link_sharing.hpp"
#include "lines/losses.hpp"

namespace itin::profile {

namespace {

void require_ground_at_ends(const Profile& profile, const Link& link) {
  if (has_ground_at_ends(profile)) return;
  const bool first = profile.points.empty() || profile.points.front().distance_m > 0;
  const Point2 p = first ? link.from : link.to;
  throw InputError(fmt::format("no ground under its {} end, {:.10g} {:.10g}", first ? "first" : "second", p.x, p.y));
}

/// Surveys a link. `along(bare)` is its cross-section over the surface, or over the ground without what stands on it.
template <class Along>
LinkResult survey(const Store& store, const LinkQuery& query, const Link& link, const Along& along) {
  const CrossSection section = along(false);
  RetrievalStatistics statistics = section.statistics;
  const Profile surface = from_section(section);
  Profile ground;
  require_ground_at_ends(surface, link);
  if (query.themes.includes_raised(store.metadata().themes)) {
    const CrossSection bare = along(true);
    statistics += bare.statistics;
    ground = from_section(bare);
  }
  LosQuery own = los_query(link, query);
  own.clearance_error_m = clearance_error(store, query.detail, query.themes, link.from, link.to);
  LinkResult result = judge_link(surface, own, ground);
  if (own.radio || !own.criteria.empty())
    add_required_heights({surface, antennas_on(result.stands_on, own), result.stands_on}, own, *result.found);
  result.statistics = statistics;
  result.triangles = section.triangles;
  return result;
}

/// Surveys many links over one surface.
class Surfaces {
 public:
  Surfaces(const Store& store, const LinkQuery& query, const std::vector<Link>& links) : store_(store), query_(query) {
    const bool has_raised = query.themes.includes_raised(store.metadata().themes);
    surface_.emplace(store, query.detail, query.themes, query.sections);
    if (!has_raised && !sharing_pays(store, query.detail, links, *surface_)) surface_.reset();
    if (has_raised) ground_.emplace(store, query.detail, ThemeChoice::none(), query.sections);
  }

  LinkResult survey(const Link& link) const {
    return profile::survey(store_, query_, link, [&](bool bare) {
      const std::optional<SectionSurface>& over = bare ? ground_ : surface_;
      return over ? over->between(link.from, link.to) : cross_section(store_, link.from, link.to, query_.detail);
    });
  }

 private:
  const Store& store_;
  const LinkQuery& query_;
  std::optional<SectionSurface> surface_;  ///< nothing: every link is retrieved by itself
  std::optional<SectionSurface> ground_;
};

/// Orders links so that those near each other follow each other, and the next finds at hand what one has read.
std::vector<std::size_t> by_place(const std::vector<Link>& links) {
  constexpr double kSide = 5000;
  const auto cell = [](double v) { return static_cast<std::int64_t>(std::floor(v / kSide)); };
  std::vector<std::tuple<std::int64_t, std::int64_t, std::size_t>> order;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const std::int64_t row = cell((links[i].from.y + links[i].to.y) / 2);
    const std::int64_t column = cell((links[i].from.x + links[i].to.x) / 2);
    order.emplace_back(row, row % 2 == 0 ? column : -column, i);  // there and back again
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> places;
  for (const auto& [row, column, i] : order) places.push_back(i);
  return places;
}

}  // namespace

LinkResult judge_link(const Profile& profile, const LosQuery& query, const Profile& ground) {
  require_valid(profile, query, ground);
  LinkResult result;
  result.distance_m = profile.length_m;
  result.gap_m = profile.gap_length_m();
  result.radio = query.radio;
  result.stands_on = stands_on(profile, ground, query);
  const Antennas antennas = antennas_on(result.stands_on, query);
  result.found = findings({profile, antennas, result.stands_on}, query);
  const Profile* under = ground.points.empty() ? nullptr : &ground;
  result.losses = losses_over(profile, antennas, query, under);
  if (query.radio) result.reflection = reflection(profile, antennas, *query.radio, under);
  if (query.object)
    result.visible = visible_height(profile, query.from_height_m, *query.object, query.earth, result.stands_on);
  return result;
}

std::vector<LinkResult> survey_links(const Store& store, const std::vector<Link>& links, const LinkQuery& query,
                                     Progress& progress) {
  const Surfaces surfaces(store, query, links);
  const std::vector<std::size_t> order = by_place(links);
  std::vector<LinkResult> results(links.size());
  CallProgress call(progress);
  std::atomic<std::size_t> done = 0;
  constexpr std::size_t kBatch = 64;
  parallel_for((links.size() + kBatch - 1) / kBatch, [&](std::size_t batch) {
    progress.throw_if_cancelled();
    const std::size_t end = std::min(links.size(), (batch + 1) * kBatch);
    for (std::size_t k = batch * kBatch; k < end; ++k) {
      const std::size_t i = order[k];
      try {
        results[i] = surfaces.survey(links[i]);
      } catch (const InputError& error) {
        results[i] = {};
        results[i].message = error.what();
      }
    }
    done += end - batch * kBatch;
    call.report("links", static_cast<double>(done) / static_cast<double>(links.size()));
  });
  call.finish();
  return results;
}

LosQuery los_query(const Link& link, const LinkQuery& all) {
  LosQuery query;
  query.from_height_m = link.from_height, query.to_height_m = link.to_height;
  query.from_on_surface = all.from_on_surface, query.to_on_surface = all.to_on_surface;
  query.earth = all.earth, query.nodata = all.nodata, query.object = all.object;
  query.criteria = link.criteria.empty() ? all.criteria : link.criteria;
  query.radio = all.radio, query.day = all.day;
  query.budget = all.budget.with(link.budget);
  if (link.frequency_ghz) {
    if (!query.radio) query.radio.emplace().effective_earth_km = effective_earth_km(all.earth);
    query.radio->frequency_ghz = *link.frequency_ghz;
  }
  if (query.radio && link.polarisation) query.radio->polarisation = *link.polarisation;
  return query;
}

LinkResult survey_link(const Store& store, const Link& link, const LinkQuery& query) {
  return survey(store, query, link, [&](bool bare) {
    return cross_section(store, link.from, link.to, query.detail, bare ? ThemeChoice::none() : query.themes);
  });
}

}  // namespace itin::profile
