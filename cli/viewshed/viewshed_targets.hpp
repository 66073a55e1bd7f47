// The options of `itin viewshed` that choose the cells looked at, and the place of the target in a cell.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <itin/store.hpp>
#include <viewshed/request.hpp>

#include "options/places/observer_options.hpp"
#include "program/verb.hpp"

namespace itin::cli {

class ViewshedTargets {
 public:
  void declare(CLI::App& app);
  /// Fills the request's targets and its field of view. Throws InputError.
  void validate(const ObserverOptions& observers, viewshed::Request& request);
  /// Fills in the cells of --like. Throws InputError, FileError.
  void complete(const StoreMetadata& metadata, viewshed::Request& request) const;
  /// Whether heights of targets, where any are stated, are elevations.
  bool absolute() const { return absolute_; }
  /// A line where targets stay above the ground though heights are elevations; else empty.
  std::string text(const viewshed::Request& request) const;
  /// Whether the call states the height of targets.
  bool height_given() const { return !height_text_.empty(); }
  /// "ground" or "surface".
  /// Tells how the request came to its targets.
  Document parameters(const viewshed::Request& request) const;

 private:
  std::string height_text_, radius_text_, min_radius_text_, azimuth_text_, elevation_text_, cell_text_, like_;
  std::string on_ = "ground";
  bool absolute_ = false;
};

}  // namespace itin::cli
