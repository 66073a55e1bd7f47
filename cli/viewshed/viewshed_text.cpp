#include "viewshed/viewshed_text.hpp"

#include <fmt/format.h>

#include <itin/surface_text.hpp>
#include <viewshed/area_text.hpp>
#include <viewshed/documents.hpp>

#include "output/store_document.hpp"
#include "viewshed/viewshed_radio.hpp"

namespace itin::cli {

namespace {

std::string certified_text(const viewshed::Result& result) {
  const viewshed::CellCounts& cells = result.cells;
  std::string text = fmt::format("certainly visible: {}; certainly hidden: {}; undecided: {} ({:.1f} % decided)\n",
                                 counted(cells.visible, "cell"), grouped(cells.hidden), grouped(cells.undecided),
                                 viewshed::decided_percent(cells));
  if (result.decided_exactly) text += "decided exactly, over every stored point: this tolerance would cost no less\n";
  if (cells.undecided > 0)
    text += result.decided_exactly
                ? "undecided across ground without data alone: --nodata block or clear decides that\n"
                : "undecided at this tolerance, or across ground without data: --mode visible decides the former, "
                  "--nodata block or clear the latter\n";
  return text;
}

/// The cells whose value is unknown only because of ground without data, in modes that give every cell a value.
std::string unknown_values_text(const viewshed::Result& result) {
  const auto without = viewshed::cells_without_value(result);
  if (!without || without->cells == 0 || !result.leaves_open()) return "";
  return fmt::format(
      "no {} is known of {}, to which lines cross ground without data; --nodata block or clear decides them\n",
      without->value, counted(without->cells, "cell"));
}

std::string plain_text(const viewshed::Result& result) {
  const viewshed::CellCounts& cells = result.cells;
  const std::uint64_t decided = cells.visible + cells.hidden;
  const double share = decided == 0 ? 0 : 100.0 * static_cast<double>(cells.visible) / static_cast<double>(decided);
  const viewshed::Mode mode = result.request.mode;
  std::string text;
  const bool paths = mode == viewshed::Mode::kLoss || mode == viewshed::Mode::kLevel;
  if (mode == viewshed::Mode::kFresnel || paths) text += radio_text(result);
  if (mode != viewshed::Mode::kFresnel)
    text += fmt::format("visible{}: {} of {} ({:.1f} %), {}\n",
                        mode == viewshed::Mode::kProbability ? " if all heights are exact" : "", grouped(cells.visible),
                        counted(decided, cells.undecided > 0 ? "decided cell" : "cell"), share,
                        viewshed::area_text(static_cast<double>(cells.visible) * result.grid.cell_area()));
  if (cells.undecided > 0)
    text += fmt::format("undecided: {}, across ground without data; --nodata block or clear decides them\n",
                        counted(cells.undecided, "cell"));
  return paths ? text : text + unknown_values_text(result);
}

}  // namespace

std::string viewshed_text(const StoreMetadata& metadata, const viewshed::Result& result,
                          const viewshed::MissingGround& missing) {
  std::string text = result.certified ? certified_text(result) : plain_text(result);
  if (!result.decided_exactly && result.request.detail.coarsest() > 0) {
    text += "surface: " + surface_text(metadata, result.request.detail);
    const bool features = result.request.themes.includes_raised(metadata.themes);
    text += features && !result.certified ? "; lower features may be left out\n" : "\n";
  }
  if (const std::string omitted = omitted_text(result.request.themes); !omitted.empty()) text += omitted + "\n";
  if (missing.share() > 0) text += fmt::format("no ground data: {} of the area looked at\n", missing.text());
  return text + fmt::format("{}, {}; {}\n", counted(result.statistics.triangles, "triangle"),
                            counted(result.statistics.lines, "line"), result.request.earth.convention());
}

}  // namespace itin::cli
