// `--horizon FILE`: the sky line of an observer as a table or a drawn panorama, with named places in or out of sight.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/sites.hpp>
#include <itin/store.hpp>
#include <viewshed/horizon.hpp>

#include "options/places/in_crs.hpp"
#include "program/verb.hpp"
#include "viewshed/viewshed_targets.hpp"

namespace itin::cli {

class HorizonOutput {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  const std::vector<std::string>& paths() const { return paths_; }
  /// Reads the targets. `targets` tells what the call says of their heights. `warnings` gets one where the file's
  /// heights are not used. Throws FileError, InputError.
  void read_targets(const viewshed::Request& request, const ViewshedTargets& targets, const InCrs& in_crs,
                    const StoreMetadata& metadata, std::vector<std::string>& warnings);
  /// The parameters: the targets' file and its fields.
  Document parameters() const;

  /// Computes and writes the files asked for, if any. Returns the document of the horizon's targets, or null.
  /// `warnings` gets one where the sky line is the edge of the data. Throws InputError, FileError.
  Document write(const Store& store, viewshed::ViewshedWithSurface& computed, const viewshed::Request& request,
                 const viewshed::ComputeOptions& options, bool overwrite, Progress& progress,
                 std::vector<std::string>& warnings) const;

 private:
  std::vector<std::string> paths_;
  std::string step_text_;
  double step_deg_ = 0.1;
  SiteQuery sites_;
  std::vector<viewshed::HorizonTarget> targets_;
};

}  // namespace itin::cli
