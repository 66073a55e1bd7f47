// What is seen from viewpoints.
#pragma once

#include <vector>

#include <itin/cross_section.hpp>
#include <itin/store.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// The surfaces that eyes look over.
struct StudySurfaces {
  SectionSurface ground;
  std::optional<SectionSurface> features;  ///< with what screens, where asked for

  StudySurfaces(const Store& store, const ZoneRequest& request);
};

/// Looks from each viewpoint. Those without ground become bad rows of the table. Throws CorruptStore, Cancelled.
std::vector<StudiedViewpoint> study_viewpoints(const StudySurfaces& surfaces, const Zone& zone,
                                               const StoreMetadata& metadata, ViewpointTable& table,
                                               Progress& progress);

}  // namespace itin::viewshed
