// What results of siting are called: of sites that serve, and of turbines that are seen.
#pragma once

#include <string>

#include "site/site_result.hpp"

namespace itin::cli {

struct SiteWording {
  std::string one, mark;         ///< what a chosen one is called; `mark` with a capital
  std::string served, unserved;  ///< kinds of places on maps, with capitals
  std::string by;                ///< heads the map, before how many are chosen
  std::string how_many;          ///< heads the map of counts
  std::string count, nearest;    ///< describe bands of rasters
  std::string coverage_curve;    ///< a heading
  std::string order, count_heading;
  std::string bound;       ///< "no choice serves more than"
  std::string sufficient;  ///< why a first look was enough for some
};

SiteWording wording_of(const SiteOptions& options);

/// Returns "certainly " where ground without data leaves something open; otherwise an empty text.
std::string certainly(const SiteResult& result);

/// Tells how much ground without data leaves open, and which options decide it.
std::string undecided_in_words(const SiteResult& result);

/// Tells how much of the demand the sites serve: "which together serve 57 of a demand of 129 (44.2 %)".
std::string served_in_words(const SiteResult& result);

/// Tells what sees the turbines, or how much of them is seen, and what is proved of that; a sentence or two.
std::string least_in_words(const SiteResult& result);

}  // namespace itin::cli
