// A line-of-sight report as a file a planner can hand in.
//
//   const profile::LosReport report = profile::analyse(line, query);
//   profile::write_report(report, "{}", "link.pdf", false);
//
// By the name's ending: .json (the document as given), .csv (one row a point of the profile), .svg, .pdf, .png (the
// drawing; the PDF has a second page of tables and the trade-off chart), .html (all of it, self-contained), .kml and
// .gpkg (the line, its ends, the critical point and the obstructions; for profiles with positions).
#pragma once

#include <string>

#include <profile/los.hpp>

namespace itin::profile {

/// Throws InputError for another ending, and for .kml and .gpkg of a profile without positions.
void require_report_format(const std::string& path, bool has_positions);

/// Equal reports give equal bytes. Throws as require_report_format() does, and FileError.
void write_report(const LosReport& report, const std::string& json, const std::string& path, bool overwrite);

}  // namespace itin::profile
