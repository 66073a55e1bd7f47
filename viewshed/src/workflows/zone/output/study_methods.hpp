// The text on methods of a study, for a chapter of an application.
#pragma once

#include <string>

#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Returns the text as Markdown.
std::string methods_text(const ZoneStudy& study, const ZoneStudyFileOptions& options);

}  // namespace itin::viewshed
