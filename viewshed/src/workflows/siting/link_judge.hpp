// Judges many lines over one surface one after another, keeping the tiles of it that were triangulated.
//
//   const LinkJudge judge(store, link_rules(request), section_cache_within(request.memory_bytes));
//   if (judge.linked(a, b)) ...
#pragma once

#include <optional>
#include <string>
#include <utility>

#include <itin/cross_section.hpp>
#include <itin/store.hpp>
#include <profile/los.hpp>
#include <viewshed/site_links.hpp>

namespace itin::viewshed {

class LinkJudge {
 public:
  /// The judge refers to the store.
  LinkJudge(const Store& store, LinkRules rules, const SectionSurface::Options& cache);

  /// Judges the line as `itin los` does. May be called from several threads. Throws InputError where an end has no
  /// ground.
  profile::LineFindings found(const SitePosition& from, const SitePosition& to) const;
  /// A line with its budget, which is nothing where the rules ask for none, or an antenna is within a feature.
  struct Measured {
    profile::LineFindings found;
    std::optional<profile::LinkBudget> budget;
    std::string sector = {};  ///< the antenna of the first end whose level is the greatest, where it has several
  };
  /// Judges the line, and works out its budget. Throws as found() does.
  Measured measured(const SitePosition& from, const SitePosition& to) const;
  /// Tells whether the line meets the rules.
  bool linked(const SitePosition& from, const SitePosition& to) const { return rules_.met_by(found(from, to)); }
  const LinkRules& rules() const { return rules_; }

 private:
  /// The profiles of the line over the surface and, under raised features, over the ground; else that is empty.
  std::pair<profile::Profile, profile::Profile> profiles(const SitePosition& from, const SitePosition& to) const;

  LinkRules rules_;
  SectionSurface surface_;
  std::optional<SectionSurface> ground_;  ///< under the raised features
};

}  // namespace itin::viewshed
