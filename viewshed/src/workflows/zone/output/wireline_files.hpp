// The wirelines and sheets of viewpoints.
#pragma once

#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Tells whether `name` is the viewpoint's name or its number.
bool is_called(const Viewpoint& v, const std::string& name);

/// Writes wireline-N-NAME.svg, .pdf and .png of each viewpoint chosen; with sheets also -planar.pdf, -cylindrical.pdf
/// and viewpoint-N-NAME.pdf. Throws FileError, Cancelled.
std::vector<ZoneFile> write_wirelines(const std::string& folder, const Store& store, const ZoneStudy& study,
                                      const WirelineChoice& choice, const profile::SheetChoice& sheets,
                                      Progress& progress);

}  // namespace itin::viewshed
