// Observers: `--observer` or `--observers FILE`, and what their heights mean.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/sites.hpp>
#include <itin/store.hpp>

#include "options/places/in_crs.hpp"
#include "options/places/view_fields.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"

namespace itin::cli {

class ObserverOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  /// Whether every h of the call is an elevation.
  bool absolute_heights() const { return absolute_heights_; }
  /// Whether a field of the file holds heights of targets.
  bool reads_target_heights() const { return views_.reads_target_heights(); }
  bool on_surface() const { return observer_on_ == "surface"; }
  const InCrs& in_crs() const { return in_crs_; }
  /// Returns at least one observer, in the store's CRS. `request` holds what is said of all of them, and
  /// `target_height_given` tells whether that has a height of targets. `warnings` gets a line for what a file has and
  /// is not used. Throws InputError, FileError.
  std::vector<viewshed::Observer> observers(const StoreMetadata& metadata, const viewshed::Request& request,
                                            bool target_height_given, std::vector<std::string>& warnings);
  /// The parameters, with the fields that heights and names were taken from; known after observers().
  Document parameters() const;
  /// A line about heights that a file gives unasked; empty where it gives none. Known after observers().
  std::string text() const;

 private:
  std::vector<viewshed::Observer> observers_given(const StoreMetadata& metadata) const;
  std::vector<viewshed::Observer> observers_of_file(const StoreMetadata& metadata, const viewshed::Request& request,
                                                    bool target_height_given, std::vector<std::string>& warnings) const;
  double height_of(const std::string& where, std::optional<double> own) const;
  bool absolute() const { return absolute_heights_ || absolute_; }

  std::vector<std::string> observers_, names_;
  SiteQuery sites_;
  std::string height_text_;
  std::string observer_on_ = "ground";
  bool absolute_heights_ = false, absolute_ = false;
  InCrs in_crs_;
  ViewFields views_;
  bool took_heights_ = false;  ///< from the usual field, which the call did not ask for

  double height_ = 2;  ///< for observers that have none of their own
  std::vector<Place> given_;
};

Document observers_document(const std::vector<viewshed::Observer>& observers);

}  // namespace itin::cli
