#include "viewshed/viewshed_sheet.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/output_file.hpp>
#include <itin/surface_text.hpp>
#include <viewshed/result_map.hpp>
#include <viewshed/result_sheet.hpp>

#include "output/store_document.hpp"
#include "viewshed/viewshed_radio.hpp"
#include "viewshed/viewshed_title.hpp"

namespace itin::cli {

namespace {

std::string observers_in_words(const viewshed::Request& request) {
  const viewshed::Observer& first = request.observers.front();
  const bool alike = std::all_of(request.observers.begin(), request.observers.end(), [&](const viewshed::Observer& o) {
    return o.height == first.height && o.absolute == first.absolute;
  });
  const std::string count = viewshed::counted_observers(request.observers);
  if (!alike) return count + " at heights of their own";
  return fmt::format("{}, {:g} m {}", count, first.height, first.absolute ? "above datum" : "above the ground");
}

profile::TitleBlock title_of_map(const Store& store, const viewshed::Result& result, const ViewshedSheetFacts& facts) {
  const viewshed::Request& request = result.request;
  profile::TitleBlock block;
  block.title = title_of(result);
  const Detail detail = answered_detail(result);
  block.statement = viewshed::statement_of(store.metadata(), request.themes, detail);
  block.facts = {{"Observers", observers_in_words(request)}};
  if (request.mode != viewshed::Mode::kHeight)
    block.facts.emplace_back("Targets", fmt::format("{:g} m {}", request.target_height,
                                                    request.target_absolute ? "above datum" : "above the ground"));
  if (request.radius) block.facts.emplace_back("Radius", fmt::format("{:g} km", *request.radius / 1000));
  block.facts.emplace_back("Cells", fmt::format("{:g} m, decided at their centres", result.grid.cell_width()));
  if (const auto criterion = radio_criterion(request)) block.facts.emplace_back("Radio", *criterion);
  if (!facts.foliage.empty()) block.facts.emplace_back("Foliage", facts.foliage);
  block.facts.emplace_back("Earth", request.earth.convention());
  block.facts.push_back(viewshed::terrain_fact(store.metadata(), detail));
  if (result.certified && !result.decided_exactly)
    block.facts.emplace_back("Looked at", surface_text(store.metadata(), request.detail));
  block.sources = facts.sources;
  return block;
}

}  // namespace

void write_viewshed_sheet(const Store& store, const viewshed::Result& result, const SheetOptions& options,
                          const ViewshedSheetFacts& facts, bool overwrite, Progress& progress) {
  if (options.file().empty()) return;
  viewshed::ResultSheet sheet{
      result.grid,
      result.grid.bounds(),
      viewshed::result_map(result, {}),
      "Share of the cells with terrain data in view",
      viewshed::in_cells(result.grid,
                         [&](std::size_t cell) { return result.visible[cell] != viewshed::Verdict::kOutside; }),
      {},
      title_of_map(store, result, facts),
      viewshed::missing_on_sheet(viewshed::places_without_ground(store, result, progress), facts.missing,
                                 kAreaLookedAt),
      kOutOfView};
  sheet.objects.push_back(viewshed::observer_objects(result.request.observers));
  write_file(options.file(),
             draw_result_sheet(store, sheet, options.papers().front(), options.choice(), options.file(), progress),
             overwrite);
}

}  // namespace itin::cli
