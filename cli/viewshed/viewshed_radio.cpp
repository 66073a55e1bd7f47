#include "viewshed/viewshed_radio.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/precondition.hpp>
#include <profile/budget_text.hpp>
#include <viewshed/area_text.hpp>
#include <viewshed/documents.hpp>

#include "output/store_document.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

double percent(std::uint64_t part, std::uint64_t all) {
  return all == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(all);
}

std::string zone_text(const viewshed::Result& result) {
  const viewshed::CellCounts& cells = result.cells;
  const std::uint64_t decided = cells.visible + cells.zone_cut + cells.hidden;
  const auto area = [&](std::uint64_t count) {
    return viewshed::area_text(static_cast<double>(count) * result.grid.cell_area());
  };
  return fmt::format(
      "in sight with {:g} F1 clear: {} of {} ({:.1f} %), {}; in sight with the zone cut: {} ({:.1f} %), {}\n",
      result.request.fresnel.fraction, grouped(cells.visible),
      counted(decided, cells.undecided > 0 ? "decided cell" : "cell"), percent(cells.visible, decided),
      area(cells.visible), grouped(cells.zone_cut), percent(cells.zone_cut, decided), area(cells.zone_cut));
}

/// Tells whether observers have antennas of their own, as the sectors of a mast have.
const char* own_antennas_text(const viewshed::Request& request) {
  const bool own = std::any_of(request.observers.begin(), request.observers.end(),
                               [](const viewshed::Observer& observer) { return !observer.antenna.empty(); });
  return own ? "; observers with antennas, azimuths and tilts of their own" : "";
}

/// In how many cells the loss, or the level, is known, and why not in the others.
std::string known_text(const char* value, const viewshed::Result& result) {
  const std::uint64_t in_view = result.cells.in_view();
  const viewshed::CellsWithoutValue without = *viewshed::cells_without_value(result);
  std::string text =
      fmt::format("{} known in {} of {}\n", value, grouped(in_view - without.cells), counted(in_view, "cell"));
  if (without.cells > 0)
    text += fmt::format(
        "without a {}: {} ({:.1f} %): the line crosses ground without data (--nodata block or clear decides that), "
        "an end lies within a feature, or the cell is the observer's own\n",
        without.value, counted(without.cells, "cell"), percent(without.cells, in_view));
  return text;
}

std::string level_text(const viewshed::Result& result) {
  std::string text = known_text("level", result);
  const std::uint64_t known = result.cells.in_view() - viewshed::cells_without_value(result)->cells;
  for (const viewshed::CellsWithMargin& with : viewshed::cells_with_margins(result))
    text += fmt::format("at or above the sensitivity{}: {} of {} ({:.1f} %), {}\n",
                        with.margin_db == 0 ? "" : fmt::format(" with {:g} dB to spare", with.margin_db),
                        grouped(with.cells), counted(known, "cell"), percent(with.cells, known),
                        viewshed::area_text(static_cast<double>(with.cells) * result.grid.cell_area()));
  constexpr std::size_t kMostObservers = 12;
  const std::vector<viewshed::CellsOfObserver> served = viewshed::cells_of_observers(result);
  if (served.empty() || served.size() > kMostObservers) return text;
  text += "served best by";
  for (const viewshed::CellsOfObserver& of : served)
    text += fmt::format("{} {}: {} ({:.1f} %)", of.observer == 0 ? "" : ",", result.request.observers[of.observer].name,
                        counted(of.cells, "cell"), percent(of.cells, known));
  return text + "\n";
}

}  // namespace

void ViewshedRadio::declare(CLI::App& app) {
  begin_group(app, kRadio);
  wave_.declare(app,
                "Tell in sight with the first Fresnel zone clear at this frequency (1) from in sight with the zone cut "
                "(3): GHz, or 7500MHz");
  declare_fresnel(app, fresnel_text_);
  app.add_flag("--loss", loss_,
               "With --frequency: the path loss to each cell instead, dB, in two bands, diffraction (ITU-R P.526 "
               "delta-Bullington) and free space; of several observers that of the best one, which has the least sum. "
               "With --power-dbm or --eirp-dbm, which need no --loss: the level that a receiver gets, dBm");
  budget_.declare(app, {"an observer", "the receiver", false});
  app.add_option("--margin-db", margins_text_,
                 "Margins over the sensitivity by which regions (-o .gpkg, .geojson), styles and legends tell levels "
                 "apart (default: 0)")
      ->type_name("DB[,DB...]");
}

void ViewshedRadio::validate() {
  wave_.validate();
  budget_.validate();
  require_frequency_of_zone(fresnel_text_, wave_.has_frequency());
  if (!wave_.has_frequency() && loss_) throw InputError("--loss needs a --frequency: losses depend on it");
  budget_.require_frequency(wave_.wave());
  loss_ = loss_ || budget_.given();
  validate_losses();
  if (!fresnel_text_.empty()) fraction_ = parse_fresnel(fresnel_text_);
  if (!margins_text_.empty()) take_margins();
}

void ViewshedRadio::validate_losses() const {
  if (loss_ && !fresnel_text_.empty())
    throw InputError(fmt::format("{} and --fresnel exclude each other: a loss is of the whole path; give one of them",
                                 budget_.given() ? "a link budget" : "--loss"));
  if (!loss_ && wave_.is_detailed())
    throw InputError("--polarisation and --over-sea work only with --loss or a link budget (--power-dbm, --eirp-dbm)");
}

void ViewshedRadio::take_margins() {
  if (!budget_.query().sensitivity_dbm)
    throw InputError("--margin-db is over the sensitivity: give --sensitivity-dbm, and --power-dbm or --eirp-dbm");
  margins_db_ = parse_numbers("--margin-db", margins_text_);
}

void ViewshedRadio::complete(viewshed::Request& request) const {
  ITIN_PRECONDITION(is_given());
  request.mode = budget_.given() ? viewshed::Mode::kLevel : loss_ ? viewshed::Mode::kLoss : viewshed::Mode::kFresnel;
  request.radio = *wave_.path(request.earth);
  request.fresnel = {wavelength_m(request.radio.frequency_ghz), fraction_};
  request.budget = budget_.query();
  request.margins_db = margins_db_;
}

Document ViewshedRadio::parameters() const {
  Document parameters = wave_.parameters();
  if (!is_given()) return parameters;
  if (!loss_) return {{"frequency_ghz", parameters["frequency_ghz"]}, {"fresnel", fraction_}};
  parameters.update(budget_.parameters());
  if (!margins_db_.empty()) parameters["margins_db"] = margins_db_;
  return parameters;
}

std::optional<std::string> radio_criterion(const viewshed::Request& request) {
  switch (request.mode) {
    case viewshed::Mode::kFresnel:
      return fmt::format("clear: {:g} of the first Fresnel zone's radius", request.fresnel.fraction);
    case viewshed::Mode::kLoss:
      return "ITU-R P.526, delta-Bullington";
    case viewshed::Mode::kLevel:
      return profile::radios_text(request.budget) + own_antennas_text(request) +
             "; free space, diffraction (ITU-R P.526, delta-Bullington), gases (P.676)";
    default:
      return std::nullopt;
  }
}

std::string radio_text(const viewshed::Result& result) {
  switch (result.request.mode) {
    case viewshed::Mode::kLevel:
      return level_text(result);
    case viewshed::Mode::kLoss:
      return known_text("diffraction loss", result);
    default:
      return zone_text(result);
  }
}

}  // namespace itin::cli
