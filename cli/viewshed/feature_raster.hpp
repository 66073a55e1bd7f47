// `--features FILE`: a raster of the raised theme under each cell of a viewshed.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/detail.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class FeatureRaster {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate() const;
  /// The raster to write, if any; its style for QGIS lies beside it.
  std::vector<std::string> paths() const;

  /// Throws InputError where a file is asked for, but no chosen theme stands on the ground or a number exceeds a byte.
  void require_themes(const StoreMetadata& metadata, const ThemeChoice& themes) const;

  struct Surface {
    Detail detail;
    ThemeChoice themes;
  };
  /// Writes, at each cell's centre, the number of the theme that the surface is part of: 0 for ground and where there
  /// is no surface; the first where several themes meet. The document tells the number of cells of each theme; it is
  /// null where no file is asked for. Memory follows the raster. Throws FileError, CorruptStore, Cancelled.
  Document write(const Store& store, const RasterGrid& grid, const Surface& surface, bool overwrite,
                 Progress& progress) const;

 private:
  std::string path_;
};

}  // namespace itin::cli
