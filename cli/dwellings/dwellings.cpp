// itin dwellings: what a wind farm is to the dwellings about it.

#include <algorithm>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/document.hpp>
#include <itin/store.hpp>
#include <itin/store_scale.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/dwellings.hpp>
#include <viewshed/dwellings_document.hpp>

#include "dwellings/dwellings_options.hpp"
#include "output/store_document.hpp"
#include "program/verb.hpp"

namespace itin::cli {

namespace {

class DwellingsVerb final : public Verb {
 public:
  std::string name() const override { return "dwellings"; }
  std::string summary() const override {
    return "Tell what dwellings see of wind turbines, facade by facade, and when their shadows flicker there";
  }
  void declare(CLI::App& app) override { options_.declare(app); }
  void validate() override { options_.validate(); }
  Document parameters() const override { return options_.parameters(); }

  Result execute(Progress& progress) override {
    viewshed::require_dwellings_folder(options_.directory, options_.policy.overwrite);
    const Store store(options_.store, cache_within(options_.memory_bytes()));
    CallProgress call(progress);
    const viewshed::DwellingsSurvey survey = viewshed::survey_dwellings(
        store, options_.complete_request(store, call), call.step(options_.sheets().given() ? 0.5 : 0.95));
    Result result;
    result.warnings = survey.warnings;
    warn_of_grid(store.metadata(), result.warnings);
    result.document = viewshed::dwellings_document(survey);
    viewshed::DwellingsFileOptions files;
    files.manifest = [&](const std::vector<viewshed::PlanFile>& written) {
      result.document["outputs"] = viewshed::outputs_document(written);
      return folder_document(*this, result);
    };
    files.overwrite = options_.policy.overwrite;
    files.sheets = options_.sheets().choice(), files.sheets_of = options_.sheets_of();
    viewshed::write_dwellings(options_.directory, store, survey, files, call.step(1));
    call.finish();
    result.text = text(survey, result.document);
    return result;
  }

 private:
  std::string text(const viewshed::DwellingsSurvey& survey, const Document& document) const {
    const Document& counts = document["dwellings"];
    const viewshed::FlickerRules& rules = survey.request.flicker;
    const auto count = [&](const char* name) { return grouped(counts[name].get<std::uint64_t>()); };
    const std::string screened = counts["see_a_tip_screened"].is_null()
                                     ? ""
                                     : fmt::format(", from {} past what stands on it", count("see_a_tip_screened"));
    return fmt::format(
        "a blade tip is seen over the bare ground from {} of {}{}\n"
        "{}"
        "shadow flicker in {}, worst case: {} have some\n"
        "more than {:g} hours in the year: {}; more than {:g} minutes on a day: {}\n"
        "{}, {}, {}; {}\n{}: open dwellings.csv and facades.csv; calendar.csv has the times, by {}\n",
        count("see_a_tip"), counted(survey.dwellings.size(), "dwelling"), screened, seasons_text(document),
        rules.year.year, count("with_flicker"), rules.limit_minutes_year / 60, count("over_year"),
        rules.limit_minutes_day, count("over_day"), counted(survey.request.turbines.turbines.size(), "turbine"),
        counted(survey.statistics.triangles, "triangle"), counted(survey.statistics.lines, "sight line"),
        survey.request.earth.convention(), options_.directory, document["flicker"]["clock"].get<std::string>());
  }

  static std::string seasons_text(const Document& document) {
    if (!document.contains("foliage")) return "";
    const Document& foliage = document["foliage"];
    return fmt::format("through foliage: a blade tip is seen from {} in summer; from {} in winter\n",
                       grouped(foliage["see_a_tip_summer"].get<std::uint64_t>()),
                       grouped(foliage["see_a_tip_winter"].get<std::uint64_t>()));
  }

  DwellingsOptions options_;
};

}  // namespace

std::unique_ptr<Verb> make_dwellings_verb() {
  return std::make_unique<DwellingsVerb>();
}

}  // namespace itin::cli
