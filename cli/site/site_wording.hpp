// The result of siting in sentences.
#pragma once

#include <string>

#include <viewshed/site_plan.hpp>

namespace itin::cli {

/// Returns a quantity of demand, in whole numbers or six digits: "47,873".
std::string amount(double quantity);

/// Returns what a quantity of the demand counts, where it has no weights, with a space before it: " cells".
const char* unit_of_demand(const viewshed::SitePlan& plan);

/// Returns "certainly " where ground without data leaves something open; otherwise an empty text.
std::string certainly(const viewshed::SitePlan& plan);

/// Tells how much ground without data leaves open, and which options decide it.
std::string undecided_in_words(const viewshed::SitePlan& plan);

/// Tells how much of the demand the sites serve: "57 of a demand of 129 (44.2 %)".
std::string amount_served_in_words(const viewshed::SitePlan& plan);

/// Tells which sites serve how much of the demand: "which together serve 57 of a demand of 129 (44.2 %)".
std::string served_in_words(const viewshed::SitePlan& plan);

/// Tells what the sites cost together, where a share or a budget was asked for, and the bound on it; else empty.
std::string cost_in_words(const viewshed::SitePlan& plan);

/// Tells what sees the turbines, or how much of them is seen, and what is proved of that; a sentence or two.
std::string least_in_words(const viewshed::SitePlan& plan);

}  // namespace itin::cli
