// A study of wind farms as a JSON document, with names that stay the same from release to release.
#pragma once

#include <string>
#include <vector>

#include <itin/document.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// The document without the call and its outputs. `decides` is what decides where ground without data leaves something
/// open.
Document zone_study_document(const ZoneStudy& study, const std::string& decides);

/// Returns `outputs`: the files that were written into the folder.
Document outputs_document(const std::string& folder, const std::vector<ZoneFile>& files);

}  // namespace itin::viewshed
