// `--features FILE`: which raised theme is under each cell of a viewshed.
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
  /// The file to write, if any.
  std::vector<std::string> paths() const;

  /// Throws InputError where a file is asked for, but no chosen theme stands on the ground or a number exceeds a byte.
  void require_themes(const StoreMetadata& metadata, const ThemeChoice& themes) const;

  struct Surface {
    Detail detail;
    ThemeChoice themes;
  };
  /// Writes the number of the theme that the surface is part of at each cell's centre, 0 for ground and where there is
  /// none; where several meet, the first. The document tells how many cells each has; null where no file is asked for.
  /// Memory follows the raster. Throws FileError, CorruptStore, Cancelled.
  Document write(const Store& store, const RasterGrid& grid, const Surface& surface, bool overwrite,
                 Progress& progress) const;

 private:
  std::string path_;
};

}  // namespace itin::cli
