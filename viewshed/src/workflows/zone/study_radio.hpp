// Radar and radio links of a study: rasters, columns of the table of turbines, and what is said about them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <itin/document.hpp>
#include <viewshed/zone_files.hpp>
#include <viewshed/zone_study.hpp>

#include "workflows/zone/turbine_rows.hpp"

namespace itin::viewshed {

/// Returns the study's radio links, with the radius of the greatest rotor; without links where there are none.
LinkStudy exclusion_of(const ZoneStudy& study);

/// Throws InputError where none of the links can be used, or they have no frequency.
void require_links(const ZoneStudyRequest& request);

/// Returns the clearance of each turbine of the zone; empty without links.
std::vector<LinkClearance> link_clearances(const ZoneStudyRequest& request, const Zone& zone);

/// Writes the rasters of links and of the radar. Throws FileError.
std::vector<ZoneFile> write_radio_rasters(const std::string& folder, const ZoneStudy& study,
                                          const ZoneFileOptions& options);

/// Adds to the columns of the table of turbines. The study must outlive them.
void add_radio_columns(const ZoneStudy& study, std::vector<TableColumn<TurbineRow>>& columns);

/// Returns how many turbines the zone's radar sees: "9 of 12 turbines, at least in part".
std::string turbines_of_radar(const Zone& zone);
/// Returns how many turbines are concerned; empty where there are neither links nor a radar.
Document radio_document(const ZoneStudy& study);
/// Returns paragraphs for the text on methods.
std::vector<std::string> radio_methods(const ZoneStudy& study);
void warn_of_radio(const ZoneStudy& study, std::vector<std::string>& warnings);

}  // namespace itin::viewshed
