// The viewpoints of `itin ztv`, and the wirelines from them.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <itin/store.hpp>
#include <viewshed/zone_study.hpp>

#include "options/places/in_crs.hpp"
#include "program/verb.hpp"

namespace itin::cli {

class ViewpointOptions {
 public:
  void declare(CLI::App& app);
  /// Checks the options. Throws InputError.
  void validate(const InCrs& in_crs, bool sheets);
  bool given() const { return !file_.path.empty(); }
  const viewshed::WirelineChoice& wirelines() const { return choice_; }
  Document parameters() const;
  /// Adds the viewpoints to the request. Throws FileError, InputError.
  void complete(viewshed::ZoneStudyRequest& request, const StoreMetadata& metadata) const;

 private:
  viewshed::PointFile file_;
  std::string field_text_, bearing_text_, blades_text_, wirelines_text_;
  viewshed::WirelineChoice choice_;
};

}  // namespace itin::cli
