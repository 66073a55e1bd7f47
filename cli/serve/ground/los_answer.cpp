#include "serve/ground/los_answer.hpp"

#include <memory>
#include <optional>

#include <itin/store_scale.hpp>

#include "los/los_case.hpp"
#include "los/los_people.hpp"
#include "los/los_query.hpp"
#include "los/los_store.hpp"
#include "options/radio/budget_options.hpp"
#include "options/radio/earth_options.hpp"
#include "options/radio/radio_options.hpp"
#include "program/verb.hpp"
#include "serve/ground/given_options.hpp"
#include "serve/ground/sight_profile.hpp"

namespace itin::cli {

namespace {

/// The options of `itin los` about a line over a store.
class LineOptions {
 public:
  explicit LineOptions(const std::vector<std::string>& arguments) {
    CLI::App app;
    line_.declare(app);
    earth_.declare(app);
    earth_.declare_radius(app);
    radio_.declare(app);
    budget_.declare(app, {});
    people_.declare(app);
    take_arguments(app, arguments);
    refuse_files(app);
    earth_.validate();
    radio_.validate();
    budget_.validate();
    people_.validate(false);
    line_.validate(radio_.object() ? std::optional(radio_.object()->tip_m) : std::nullopt);
    radio_.require_frequency();
  }

  LosCase over(const Store& store) {
    earth_.take_body_of(store.metadata());
    const profile::LosQuery query = query_of(earth_, radio_, budget_, people_);
    budget_.require_frequency(query.radio);
    LosCase one = los_case(store, line_.run(store, query), {"", people_.facts()});
    warn_of_grid(store.metadata(), one.result.warnings);
    if (query.radio) earth_.warn_of_light(one.result.warnings);
    return one;
  }

 private:
  LosStoreOptions line_;
  EarthOptions earth_;
  RadioOptions radio_;
  BudgetOptions budget_;
  LosPeople people_;
};

}  // namespace

Document los_answer(const ServedStore& served, const std::vector<std::string>& arguments) {
  LosCase one = LineOptions(arguments).over(served.store());
  Document answer = std::move(one.result.document);
  answer["warnings"] = one.result.warnings;
  answer["profile"] = sight_profile(one.report);
  return answer;
}

Document profile_answer(const ServedStore& served, const std::vector<std::string>& arguments, Progress& progress) {
  const std::unique_ptr<Verb> verb = make_profile_verb();
  CLI::App app;
  verb->declare(app);
  take_arguments(app, call_of(served, arguments));
  refuse_files(app);
  verb->validate();
  Result result = verb->execute(progress);
  result.document["warnings"] = result.warnings;
  return std::move(result.document);
}

}  // namespace itin::cli
