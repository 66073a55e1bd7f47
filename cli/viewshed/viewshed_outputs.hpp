// Writes the files of a viewshed: rasters and polygons by -o, a map, and rasters of single observers.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/new_folder.hpp>
#include <itin/unfinished.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/viewshed.hpp>

#include "output/output_path.hpp"

namespace itin::cli {

class ViewshedOutputs {
 public:
  void declare(CLI::App& app);
  /// `others` are files that something else writes. Throws InputError.
  void validate(const std::vector<std::string>& others);
  /// Throws FileError where something cannot be written, InputError where it is GeoJSON and the CRS has no code. Makes
  /// the directory of single observers, which is removed again unless write_each() completes it.
  void prepare(const viewshed::Request& request, const std::string& crs_wkt);
  /// Lists the style that is written beside a raster among the outputs. Throws FileError as prepare() does, and
  /// InputError where the call reads or writes that file already.
  void claim_style(const std::string& raster);

  /// Lists a file that is written beside others among the outputs. Throws as claim_style() does.
  void claim_beside(const std::string& path);
  /// The rasters of -o.
  std::vector<std::string> given_rasters() const;
  bool writes_polygons() const;
  /// Whether observers have rasters of their own.
  bool writes_each() const { return !each_.empty(); }

  struct Context {
    const StoreMetadata& metadata;
    bool certified;  ///< what is certain was asked for
    const viewshed::MissingGround& missing;
    std::vector<std::string> sources;  ///< where the surface comes from, sort by sort
    std::string foliage = {};          ///< how woods are seen through; empty: they are solid
  };
  void write(const Store& store, viewshed::ViewshedWithSurface& computed, const Context& context,
             Progress& progress) const;
  /// Computes the viewshed of one observer; called for every observer whose own raster is wanted.
  using Compute = std::function<viewshed::Result(std::size_t)>;
  void write_each(const Compute& compute, const Context& context, const Progress& progress);

  /// The files in the order of the options, the others last.
  std::vector<std::string> paths() const;
  bool overwrite() const { return policy_.overwrite; }
  bool draws_map() const { return !image_.empty(); }

 private:
  std::vector<std::string> rasters() const;
  void write_raster(const std::string& path, const viewshed::Result& result, const Context& context,
                    const Progress& progress) const;

  std::vector<std::string> outputs_;
  std::string image_, each_;
  std::vector<std::string> others_;
  std::vector<std::string> single_;  ///< one path per observer, with --each
  std::vector<std::string> styles_;  ///< beside rasters
  std::optional<NewFolder> folder_;  ///< the folder of single observers' rasters
  std::deque<Unfinished> in_new_folder_;
  OutputPolicy policy_;
};

}  // namespace itin::cli
