#include "viewshed/view_warnings.hpp"

#include <itin/store_scale.hpp>

#include "program/field_names.hpp"

namespace itin::cli {

void add_view_warnings(const StoreMetadata& metadata, const ViewOptions& view, const viewshed::Result& result,
                       const viewshed::MissingGround& missing, std::vector<std::string>& warnings) {
  warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
  if (const auto warning = missing.warning("the area looked at")) warnings.push_back(in_options(*warning));
  if (result.cells.in_view() == 0)
    warnings.emplace_back(
        "no cell has its centre in view of an observer and on ground data: check --cell, --radius and the field of "
        "view");
  warn_of_grid(metadata, warnings);
  if (view.is_radio()) view.earth().warn_of_light(warnings);
}

}  // namespace itin::cli
