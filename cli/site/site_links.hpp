// Lines of sight between sites: between the chosen ones for the report, and those that hold a choice together.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <itin/store.hpp>
#include <profile/links.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/siting.hpp>

#include "site/site_inputs.hpp"

namespace itin::cli {

/// How lines between sites are judged.
struct LinkRules {
  profile::LinkQuery query;
  double fraction = 0;  ///< how much of the first Fresnel zone must be clear, 0 to 1, where there is a frequency

  /// Tells whether a line is known to be in sight, with `fraction` of the Fresnel zone clear.
  bool met_by(const profile::LineFindings& found) const {
    return found.verdict == profile::SightVerdict::kVisible && (!found.fresnel || found.fresnel->fraction >= fraction);
  }
};
LinkRules link_rules(const SiteOptions& options);

/// Returns the link between antennas or eyes at two sites.
profile::Link link_between(const viewshed::SitePosition& from, const viewshed::SitePosition& to);

struct LinkEnd {
  enum class Kind { kChosen, kExisting, kHub };
  Kind kind = Kind::kChosen;
  viewshed::SitePosition place;
};

/// A line of sight between two ends of a network, by their numbers.
struct SiteLink {
  std::size_t from = 0, to = 0;
  profile::LinkResult line;

  const profile::LineFindings& found() const { return *line.found; }
};

struct SiteNetwork {
  std::vector<LinkEnd> ends;  ///< chosen sites in their order, existing ones, the hub
  std::vector<SiteLink> links;

  const viewshed::SitePosition& from(const SiteLink& link) const { return ends[link.from].place; }
  const viewshed::SitePosition& to(const SiteLink& link) const { return ends[link.to].place; }
};

/// Returns the network with the lines between all chosen sites; where links hold the choice together, between all ends.
SiteNetwork site_network(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                         const viewshed::Choice& choice, const std::optional<viewshed::SitePosition>& hub,
                         Progress& progress);

/// Returns the links among options, existing sites and the hub that meet the rules. They refer to the store and the
/// progress.
std::shared_ptr<viewshed::LinkNetwork> link_network(const Store& store, const SiteOptions& options,
                                                    const SiteInputs& inputs,
                                                    const std::optional<viewshed::SitePosition>& hub,
                                                    Progress& progress);

}  // namespace itin::cli
