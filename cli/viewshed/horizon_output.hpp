// `--horizon FILE`: the sky line of an observer as a table or a drawn panorama, with named places in or out of sight.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/sites.hpp>
#include <itin/store.hpp>
#include <viewshed/horizon.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class HorizonOutput {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  const std::vector<std::string>& paths() const { return paths_; }
  /// Decides which fields of the targets' file are read. `height_given`: whether the call states the height of targets.
  /// `warnings` gets one where the file's heights are not used. Throws FileError.
  void take_fields(bool height_given, std::vector<std::string>& warnings);
  /// These fields.
  Document parameters() const;

  /// Computes and writes what was asked for, if anything; the document of the horizon's targets, or null. `warnings`
  /// gets one where the sky line is the edge of the data. Throws InputError, FileError.
  Document write(const Store& store, viewshed::ViewshedWithSurface& computed, const viewshed::Request& request,
                 const viewshed::ComputeOptions& options, bool overwrite, Progress& progress,
                 std::vector<std::string>& warnings) const;

 private:
  std::vector<viewshed::HorizonTarget> targets(const viewshed::Request& request, const StoreMetadata& metadata) const;

  std::vector<std::string> paths_;
  std::string step_text_;
  double step_deg_ = 0.1;
  SiteQuery sites_;
};

}  // namespace itin::cli
