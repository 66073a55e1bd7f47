// The options of `itin viewshed` that say what observers see: who looks where, at what, over which surface, and in
// which mode.
//
//   ViewOptions view;
//   view.declare_view(app), view.declare_surface(app);
//   // Once `app` has its values:
//   view.validate();
//   const viewshed::Request& request = view.complete(store, warnings, progress);
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/store.hpp>
#include <viewshed/request.hpp>

#include "options/detail_options.hpp"
#include "options/engine_option.hpp"
#include "options/foliage_options.hpp"
#include "options/nodata_option.hpp"
#include "options/places/observer_options.hpp"
#include "options/radio/earth_options.hpp"
#include "options/surface_options.hpp"
#include "viewshed/viewshed_radio.hpp"
#include "viewshed/viewshed_targets.hpp"

namespace itin::cli {

class ViewOptions {
 public:
  /// Declares observers, targets and modes.
  void declare_view(CLI::App& app);
  /// Declares radio, the surface, the Earth and engines.
  void declare_surface(CLI::App& app);
  /// Throws InputError.
  void validate();
  /// Completes the request from the store and the fields of files, and returns it. Throws InputError, FileError,
  /// CorruptStore, Cancelled.
  const viewshed::Request& complete(const Store& store, std::vector<std::string>& warnings, Progress& progress);

  /// The request as far as it is known by now.
  const viewshed::Request& request() const { return request_; }
  /// Whether the answer is asked for by certificates.
  bool certified() const { return certified_; }
  bool has_rings() const { return detail_.has_rings(); }
  bool is_radio() const { return radio_.is_given(); }
  const ObserverOptions& observers() const { return observers_; }
  const ViewshedTargets& targets() const { return targets_; }
  const EarthOptions& earth() const { return earth_; }
  const FoliageOptions& foliage() const { return foliage_; }

  // The parameters in two parts, between which documents have those of outputs.
  Document observer_parameters() const;
  Document parameters() const;

 private:
  void parse_mode();
  void validate_vertical_error();
  void validate_precise();
  void validate_foliage();

  std::string mode_text_, sigma_text_, correlation_text_;
  bool certified_ = false, precise_ = false;
  ObserverOptions observers_;
  ViewshedTargets targets_;
  DetailOptions detail_;
  ThemeOptions themes_;
  FoliageOptions foliage_;
  EarthOptions earth_;
  NoDataOption nodata_;
  EngineOption engine_;
  ViewshedRadio radio_;
  viewshed::Request request_;
};

}  // namespace itin::cli
