// Lines of sight between sites: who sees whom, and what that asks of a choice.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <itin/store.hpp>
#include <profile/links.hpp>
#include <viewshed/site_coverage.hpp>

namespace itin::cli {

/// How lines between sites are judged.
struct LinkRules {
  profile::LinkQuery query;
  double fraction = 0;  ///< of the first Fresnel zone that must be clear, where there is a frequency

  /// Known to be in sight, with so much of the zone clear.
  bool met_by(const profile::LineFindings& found) const {
    return found.verdict == profile::SightVerdict::kVisible && (!found.fresnel || found.fresnel->fraction >= fraction);
  }
};

/// Remembers what it has looked at.
class SiteLinks {
 public:
  SiteLinks(const Store& store, LinkRules rules, Progress& progress)
      : store_(store), rules_(std::move(rules)), progress_(progress) {}

  bool at_one_place(const viewshed::SiteStand& a, const viewshed::SiteStand& b) const;
  profile::LinkResult between(const viewshed::SiteStand& a, const viewshed::SiteStand& b) const;
  bool connect(const viewshed::SiteStand& a, const viewshed::SiteStand& b) const {
    return rules_.met_by(*between(a, b).found);
  }
  /// As above, for options by their number; asking again costs nothing.
  bool connect(const std::vector<viewshed::SiteStand>& stands, std::size_t a, std::size_t b) const;

 private:
  const Store& store_;
  LinkRules rules_;
  Progress& progress_;
  mutable std::map<std::pair<std::size_t, std::size_t>, bool> seen_;
};

/// Minimum spacing and intervisibility.
class SiteRules {
 public:
  /// Refers to everything given.
  SiteRules(const std::vector<viewshed::SiteStand>& stands, std::size_t options, std::optional<double> min_spacing,
            bool intervisible, std::optional<viewshed::SiteStand> hub, const SiteLinks& links)
      : stands_(stands),
        options_(options),
        min_spacing_(min_spacing),
        intervisible_(intervisible),
        hub_(std::move(hub)),
        links_(links) {}

  bool any() const { return min_spacing_ || intervisible_; }
  bool may_join(std::size_t option, std::span<const std::size_t> chosen) const;
  bool holds_together(std::span<const std::size_t> chosen) const;

 private:
  bool spaced(std::size_t a, std::size_t b) const;
  bool sees_hub(std::size_t option) const;
  /// A first site without a hub must see some other place that may follow it.
  bool sees_another_candidate(std::size_t option) const;

  const std::vector<viewshed::SiteStand>& stands_;
  std::size_t options_;
  std::optional<double> min_spacing_;
  bool intervisible_;
  std::optional<viewshed::SiteStand> hub_;
  const SiteLinks& links_;
  mutable std::map<std::size_t, bool> sees_hub_, sees_another_;
};

}  // namespace itin::cli
