// The methods text of a wind farm's visibility study, from the parameters of the run.
#pragma once

#include <string>
#include <vector>

#include <itin/earth.hpp>
#include <itin/store.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/turbines.hpp>

namespace itin::cli {

struct ZtvMethods {
  std::string turbines_file, turbines_sha256;
  std::string surface;              ///< detail and certified error
  std::vector<SourceInfo> sources;  ///< sources of the terrain and of screening features, within the study area
  viewshed::MissingGround missing;  ///< in the study area
  bool wirelines = false, sheets = false;
  std::string radius;  ///< a sentence on the radii
  std::size_t rows = 0, bad = 0;
  std::vector<std::string> further;  ///< paragraphs about further outputs
};

/// Returns curvature and refraction in words, with the drop at 10 and 40 km.
std::string refraction_in_words(const Earth& earth);

/// Returns the methods text as Markdown.
std::string methods_text(const viewshed::Zone& zone, const StoreMetadata& metadata, const ZtvMethods& facts);

}  // namespace itin::cli
