// The wirelines and sheets of viewpoints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/zone_files.hpp>

#include "options/sheet_options.hpp"
#include "ztv/ztv_sights.hpp"

namespace itin::cli {

struct WirelineChoice {
  double least_width_deg = 53.5;
  std::optional<double> bearing_deg;  ///< where the middle lies; nothing: the turbines' middle
  bool hidden_dashed = false;
  std::optional<double> blade_deg = 0;  ///< how far a blade is turned from upright; nothing: another for each turbine
  std::string alone;                    ///< sheets in pairs: this farm alone, and all; empty: no pairs
};

/// A surface and the words for the view over it.
struct ViewedSurface {
  const SectionSurface& surface;
  std::string title;   ///< what a wireline's notes call it
  std::string suffix;  ///< added to the names of its files
  std::string remark;  ///< about this viewpoint; may be empty
};

class WirelineWriter {
 public:
  WirelineWriter(std::string folder, const Store& store, const viewshed::Zone& zone, const WirelineChoice& choice,
                 const viewshed::SheetChoice& sheets)
      : folder_(std::move(folder)), store_(store), zone_(zone), choice_(choice), sheets_(sheets) {}

  /// Writes wireline-N-NAME.svg, .pdf and .png; with sheets also -planar.pdf, -cylindrical.pdf and
  /// viewpoint-N-NAME.pdf. Throws FileError, Cancelled.
  void write(const Viewpoint& v, const ViewedSurface& view, const std::vector<Sight>& sights, Progress& progress);
  std::vector<viewshed::ZoneFile> files() && { return std::move(files_); }

 private:
  void add(const std::string& name, const std::string& what, const std::string& bytes);

  std::string folder_;
  const Store& store_;
  const viewshed::Zone& zone_;
  WirelineChoice choice_;
  const viewshed::SheetChoice& sheets_;
  std::vector<viewshed::ZoneFile> files_;
};

}  // namespace itin::cli
