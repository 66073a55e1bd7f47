// The inputs of a siting run: candidates, demand, existing sites, as read and checked.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/site_coverage.hpp>

#include "site/site_options.hpp"

namespace itin::cli {

/// A place where a site may stand.
struct Candidate {
  std::string id;
  Point2 position;
  std::optional<double> height;  ///< its own; otherwise every mast is an option
  double cost = 0;
  std::string why;  ///< why it was proposed; empty for candidates that were given
};

/// Candidates that may not be chosen, all for one reason.
struct Barred {
  std::string why;                   ///< the reason, worded to follow "candidate 3 "
  std::size_t first = 0, count = 0;  ///< their range in SiteInputs::rejected
};

struct SiteInputs {
  std::vector<Candidate> candidates;
  // An option is a candidate with a mast. Existing sites follow the options in `positions`.
  std::vector<viewshed::SiteOption> options;
  std::vector<viewshed::SitePosition> positions;
  viewshed::SiteTargets targets;
  viewshed::Demand demand;
  viewshed::DemandSet cells;              ///< if cells are the demand: the cells with ground within an option's radius
  viewshed::Weight total = 0;             ///< all demand
  std::vector<std::string> rejected;      ///< a line for each row that is not used, and why
  std::vector<Barred> barred;             ///< which of `rejected` are candidates where no site may stand
  std::size_t demand_without_ground = 0;  ///< points
  std::vector<std::string> warnings;      ///< about files that may not be what was meant

  std::size_t existing() const { return positions.size() - options.size(); }
};

/// Reads the inputs. Throws InputError where no candidate is left to choose from, FileError.
SiteInputs read_site_inputs(const Store& store, const SiteOptions& options, Progress& progress);

}  // namespace itin::cli
