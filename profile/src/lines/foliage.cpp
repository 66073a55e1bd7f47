#include <algorithm>
#include <cmath>
#include <iterator>

#include <itin/cross_section.hpp>
#include <itin/store.hpp>
#include <itin/wood_loss.hpp>
#include <profile/foliage.hpp>
#include <profile/leaf_areas.hpp>

#include "lines/losses.hpp"

namespace itin::profile {

namespace {

/// Whether an antenna of the line stands within the foliage.
bool holds_end(const std::vector<FoliageStretch>& stretches, const Profile& profile) {
  return !stretches.empty() && (stretches.front().from_m == 0 || stretches.back().to_m == profile.length_m);
}

double sum_of_powers_db(double a, double b) {
  return -10 * std::log10(std::pow(10, -a / 10) + std::pow(10, -b / 10));
}

std::optional<WoodLoss> wood_loss(const FoliageSight& sight, const Profile& surface) {
  const auto& radio = sight.solid.query.radio;
  if (!radio || sight.length_m == 0) return std::nullopt;
  const auto through = wood_loss_db(1000 * radio->frequency_ghz, sight.length_m);
  if (!through) return std::nullopt;
  WoodLoss loss{*through, holds_end(sight.stretches, surface), std::nullopt, *through};
  if (loss.end_within) return loss;
  const Profile* const bare = sight.solid.ground.points.empty() ? nullptr : &sight.solid.ground;
  if (const auto over = losses_over(surface, sight.solid.antennas, sight.solid.query, bare)) {
    loss.over_db = over->ld_db;
    loss.loss_db = sum_of_powers_db(*through, over->ld_db);
  }
  return loss;
}

}  // namespace

void Foliage::set_leaf_area(const std::string& text) {
  leaf_area = text == "off" ? kLeavesOff : kLeavesOn;
  leaf_area_field = text == "on" || text == "off" ? "" : text;
}

FoliageSight through_foliage(const Store& store, const StoreLine& line, const LosQuery& query, const Foliage& foliage) {
  const LeafAreas leaves(store, line.themes, foliage);
  StoreLine solid = line;
  solid.themes = line.themes.without_vegetation();
  FoliageSight sight;
  sight.solid = analyse(store, solid, query);
  const Profile surface = from_section(cross_section(store, line.from, line.to, line.detail, line.themes));
  sight.stretches = foliage_along(surface, sight.solid.antennas, query.earth, leaves.vegetation());
  for (const FoliageStretch& stretch : sight.stretches) sight.length_m += stretch.length_m;
  const auto middle = [&](const FoliageStretch& s) { return position_at(sight.solid, (s.from_m + s.to_m) / 2); };
  std::vector<Point2> middles;
  std::transform(sight.stretches.begin(), sight.stretches.end(), std::back_inserter(middles), middle);
  sight.transmittance = leaves.transmittance(sight.stretches, leaves.at(sight.stretches, middles));
  sight.verdict = sight.transmittance < foliage.least_transmittance ? SightVerdict::kHidden : sight.solid.verdict;
  sight.loss = wood_loss(sight, surface);
  return sight;
}

}  // namespace itin::profile
