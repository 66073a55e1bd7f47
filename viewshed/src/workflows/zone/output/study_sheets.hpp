// The map sheets of a study: every map of the zone on every paper asked for.
#pragma once

#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/zone_study.hpp>

#include "workflows/zone/output/study_lines.hpp"

namespace itin::viewshed {

/// Writes sheet-NAME-A3.pdf and .png of each map. Throws FileError, InputError (a scale that is too large), Cancelled.
std::vector<ZoneFile> write_study_sheets(const std::string& folder, const Store& store, const ZoneStudy& study,
                                         const StudyLines& lines, const profile::SheetChoice& choice,
                                         Progress& progress);

}  // namespace itin::viewshed
