// What a line of sight is asked by the options of Earth, radio, budget and people.
#pragma once

#include <profile/los.hpp>

#include "los/los_people.hpp"
#include "options/radio/budget_options.hpp"
#include "options/radio/earth_options.hpp"
#include "options/radio/radio_options.hpp"

namespace itin::cli {

/// Takes the options as they are now: Earth's change with the body of a store's CRS.
inline profile::LosQuery query_of(const EarthOptions& earth, const RadioOptions& radio, const BudgetOptions& budget,
                                  const LosPeople& people) {
  profile::LosQuery query;
  query.earth = earth.earth();
  query.radio = radio.radio(query.earth);
  query.budget = budget.query();
  query.criteria = radio.criteria();
  query.object = radio.object();
  query.day = people.day();
  return query;
}

}  // namespace itin::cli
