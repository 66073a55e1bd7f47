#include "viewshed/viewshed_radio.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/precondition.hpp>
#include <viewshed/area_text.hpp>
#include <viewshed/documents.hpp>

#include "output/store_document.hpp"
#include "program/help.hpp"

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

std::string loss_text(const viewshed::Result& result) {
  const std::uint64_t in_view = result.cells.in_view(), without = viewshed::cells_without_value(result)->cells;
  std::string text =
      fmt::format("diffraction loss known in {} of {}\n", grouped(in_view - without), counted(in_view, "cell"));
  if (without > 0)
    text += fmt::format(
        "without a loss: {} ({:.1f} %): the line crosses ground without data (--nodata block or clear decides that), "
        "an end lies within a feature, or the cell is the observer's own\n",
        counted(without, "cell"), percent(without, in_view));
  return text;
}

}  // namespace

void ViewshedRadio::declare(CLI::App& app) {
  begin_group(app, kRadio);
  wave_.declare(app,
                "Tell in sight with the first Fresnel zone clear at this frequency (1) from in sight with the zone cut "
                "(3): GHz, or 7500MHz");
  declare_fresnel(app, fresnel_text_);
  app.add_flag("--loss", loss_,
               "With --frequency, what a radio path to each cell loses instead, dB, in two bands: diffraction "
               "(ITU-R P.526 delta-Bullington), and free space; of several observers that with the least sum");
}

void ViewshedRadio::validate() {
  wave_.validate();
  require_frequency_of_zone(fresnel_text_, wave_.has_frequency());
  if (!wave_.has_frequency() && loss_) throw InputError("--loss needs a --frequency: losses depend on it");
  if (loss_ && !fresnel_text_.empty())
    throw InputError("--loss and --fresnel exclude each other: a loss is of the whole path; give one of them");
  if (!loss_ && wave_.is_detailed()) throw InputError("--polarisation and --over-sea work only with --loss");
  if (!fresnel_text_.empty()) fraction_ = parse_fresnel(fresnel_text_);
}

void ViewshedRadio::complete(viewshed::Request& request) const {
  ITIN_PRECONDITION(is_given());
  request.mode = loss_ ? viewshed::Mode::kLoss : viewshed::Mode::kFresnel;
  request.radio = *wave_.path(request.earth);
  request.fresnel = {wavelength_m(request.radio.frequency_ghz), fraction_};
}

Document ViewshedRadio::parameters() const {
  Document parameters = wave_.parameters();
  if (!is_given() || loss_) return parameters;
  return {{"frequency_ghz", parameters["frequency_ghz"]}, {"fresnel", fraction_}};
}

std::optional<std::string> radio_criterion(const viewshed::Request& request) {
  if (request.mode == viewshed::Mode::kFresnel)
    return fmt::format("clear: {:g} of the first Fresnel zone's radius", request.fresnel.fraction);
  if (request.mode == viewshed::Mode::kLoss) return "ITU-R P.526, delta-Bullington";
  return std::nullopt;
}

std::string radio_text(const viewshed::Result& result) {
  return result.request.mode == viewshed::Mode::kLoss ? loss_text(result) : zone_text(result);
}

}  // namespace itin::cli
