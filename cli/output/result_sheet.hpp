// A map of cells in colours on a sheet of paper, over relief or a picture: viewsheds, visibility and sites.
#pragma once

#include <functional>
#include <string>

#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <profile/map_sheet.hpp>
#include <viewshed/result_map.hpp>

#include "options/sheet_options.hpp"

namespace itin::cli {

struct ResultSheet {
  RasterGrid grid;
  viewshed::ResultMap map;                   ///< of its cells
  std::string heading;                       ///< of the map's keys
  std::function<bool(std::size_t)> studied;  ///< whether a cell is part of the study: the others' relief is faded
  profile::SheetMarks marks;
  std::string marks_key;  ///< empty where there are none
  profile::TitleBlock title;
};

/// What screens on a map, and what does not.
std::string statement_of(const StoreMetadata& metadata, const ThemeChoice& themes);

/// The bytes of a .pdf or .png, by the ending of `name`. Throws FileError (a basemap), InputError (a scale that is too
/// large), Cancelled.
std::string draw_result_sheet(const Store& store, const ResultSheet& content, profile::PaperSize paper,
                              const SheetOptions& options, const std::string& name, Progress& progress);

}  // namespace itin::cli
