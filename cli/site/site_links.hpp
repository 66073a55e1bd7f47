// Lines of sight between sites: between the chosen ones for the report, and those that hold a choice together.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <itin/store.hpp>
#include <profile/line_of_sight.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/siting.hpp>

#include "site/site_inputs.hpp"

namespace itin::cli {

/// A line of sight between two sites, or a site and the hub.
struct SiteLink {
  viewshed::SiteStand from, to;
  double distance_m = 0;
  profile::SightLine line;
  bool visible = false;  ///< as --nodata has it
  bool clear = false;    ///< visible, and the zone is as clear as it must be
};

/// Between all chosen sites, and to the hub; where links hold the choice together, existing sites take part.
std::vector<SiteLink> site_links(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                                 const viewshed::Choice& choice, const std::optional<viewshed::SiteStand>& hub,
                                 Progress& progress);

/// The links among options, existing sites and the hub, as `itin los` judges them. Refers to the store, the options and
/// the progress.
std::shared_ptr<viewshed::LinkNetwork> link_network(const Store& store, const SiteOptions& options,
                                                    const SiteInputs& inputs,
                                                    const std::optional<viewshed::SiteStand>& hub, Progress& progress);

}  // namespace itin::cli
