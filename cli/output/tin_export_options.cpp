#include "output/tin_export_options.hpp"

namespace itin::cli {

TinExportOptions tin_export_options(const StoreMetadata& metadata, const Document& origin, bool overwrite) {
  TinExportOptions options;
  options.crs_wkt = metadata.crs_wkt;
  options.overwrite = overwrite;
  for (const ThemeInfo& theme : metadata.themes) options.theme_names.push_back(theme.name);
  Document document{{"itin", ITIN_VERSION}};
  document.update(origin);
  options.metadata_json = json_text(document);
  return options;
}

}  // namespace itin::cli
