#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/store.hpp>
#include <profile/clearance_error.hpp>
#include <profile/links.hpp>
#include <profile/profile.hpp>

#include "lines/line_clearance.hpp"
#include "lines/link_sharing.hpp"
#include "lines/sight_verdict.hpp"

namespace itin::profile {

namespace {

/// The surface, and where features stand on it the ground under them.
class Surfaces {
 public:
  Surfaces(const Store& store, const LinkQuery& query, const std::vector<Link>& links)
      : store_(store), query_(query), standing_(query.themes.includes_standing(store.metadata().themes)) {
    if (standing_ || sharing_pays(store, query.detail, links)) surface_.emplace(store, query.detail, query.themes);
    if (standing_) ground_.emplace(store, query.detail);
  }

  LinkResult survey(const Link& link) const {
    if (link.from_height < 0 || link.to_height < 0) throw InputError("a height above ground is negative");
    const Profile profile = from_section(surface_ ? surface_->between(link.from, link.to)
                                                  : cross_section(store_, link.from, link.to, query_.detail));
    LinkResult result;
    result.distance_m = profile.length_m;
    if (!has_ground_at_ends(profile)) {
      result.message = end_without_ground(profile, link);
      return result;
    }
    std::optional<Profile> bare;
    if (ground_) bare = from_section(ground_->between(link.from, link.to));
    const EndGrounds grounds = grounds_of(profile, bare);
    const Antennas antennas{grounds.from_m + link.from_height, grounds.to_m + link.to_height};
    const auto line = line_clearance(profile, antennas, query_.earth);
    const double error = clearance_error(store_, query_.detail, query_.themes, link.from, link.to);
    result.has_gaps = !profile.gaps.empty();
    result.verdict = sight_verdict(profile, line->clearance_m, {error, query_.gaps_block});
    result.clearance_m = line->clearance_m;
    result.critical_m = line->critical.distance_m;
    if (query_.object) {
      const auto& [hub, tip] = *query_.object;
      result.visible = visible_height(profile, link.from_height, hub, tip, query_.earth, grounds);
    }
    if (query_.radio && profile.has_length()) add_radio(profile, bare ? &*bare : nullptr, antennas, result);
    return result;
  }

 private:
  static std::string end_without_ground(const Profile& profile, const Link& link) {
    const bool first = profile.points.empty() || profile.points.front().distance_m > 0;
    const Point2 p = first ? link.from : link.to;
    return fmt::format("no ground under its {} end, {:.10g} {:.10g}", first ? "first" : "second", p.x, p.y);
  }

  EndGrounds grounds_of(const Profile& profile, const std::optional<Profile>& bare) const {
    EndGrounds grounds = ends_of(profile);
    if (bare && !query_.from_on_surface) grounds.from_m = ends_of(*bare).from_m;
    if (bare && !query_.to_on_surface) grounds.to_m = ends_of(*bare).to_m;
    return grounds;
  }

  void add_radio(const Profile& profile, const Profile* bare, const Antennas& antennas, LinkResult& result) const {
    const auto fresnel = fresnel_clearance(profile, antennas, query_.earth, wavelength_m(query_.radio->frequency_ghz));
    if (fresnel) result.fresnel_fraction = fresnel->fraction;
    const EndGrounds top = ends_of(profile);
    if (antennas.from_m < top.from_m || antennas.to_m < top.to_m) return;
    // A report takes the same points (los.cpp).
    const Profile dense = with_spacing(profile, std::min(100.0, profile.length_m / 50));
    result.ld_db = path_losses(dense, antennas, *query_.radio, bare).ld_db;
  }

  const Store& store_;
  const LinkQuery& query_;
  bool standing_;
  std::optional<SectionSurface> surface_;  ///< where none, every link is retrieved by itself
  std::optional<SectionSurface> ground_;
};

/// Links that lie near each other come near each other, so that what one has read is at hand for the next.
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

std::vector<LinkResult> survey_links(const Store& store, const std::vector<Link>& links, const LinkQuery& query,
                                     Progress& progress) {
  const Surfaces surfaces(store, query, links);
  const std::vector<std::size_t> order = by_place(links);
  std::vector<LinkResult> results(links.size());
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
    progress.report("links", static_cast<double>(done) / static_cast<double>(links.size()));
  });
  return results;
}

}  // namespace itin::profile
