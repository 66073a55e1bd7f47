// itin premises: which buildings which masts serve, and what stops the rest.

#include <algorithm>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/document.hpp>
#include <itin/store.hpp>
#include <itin/store_scale.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/premises.hpp>
#include <viewshed/premises_document.hpp>

#include "output/store_document.hpp"
#include "premises/premises_options.hpp"
#include "program/verb.hpp"

namespace itin::cli {

namespace {

class PremisesVerb final : public Verb {
 public:
  std::string name() const override { return "premises"; }
  std::string summary() const override {
    return "Tell which buildings masts serve, at which height on which wall or roof, and what stops the rest";
  }
  void declare(CLI::App& app) override { options_.declare(app); }
  void validate() override { options_.validate(); }
  Document parameters() const override { return options_.parameters(); }

  Result execute(Progress& progress) override {
    viewshed::require_premises_folder(options_.directory, options_.policy.overwrite);
    const Store store(options_.store, cache_within(options_.memory_bytes()));
    CallProgress call(progress);
    const viewshed::PremisesSurvey survey =
        viewshed::survey_premises(store, options_.complete_request(store, call), call.step(0.8));
    Result result;
    result.warnings = survey.warnings;
    options_.warn_of_light(result.warnings);
    warn_of_grid(store.metadata(), result.warnings);
    result.document = viewshed::premises_document(survey);
    viewshed::PremisesFileOptions files;
    files.manifest = [&](const std::vector<viewshed::PlanFile>& written) {
      result.document["outputs"] = viewshed::outputs_document(written);
      return folder_document(*this, result);
    };
    files.overwrite = options_.policy.overwrite;
    files.sheets = options_.sheets().choice();
    viewshed::write_premises(options_.directory, store, survey, files, call.step(1));
    call.finish();
    result.text = text(survey);
    return result;
  }

 private:
  std::string text(const viewshed::PremisesSurvey& survey) const {
    const viewshed::PremisesCounts counts = survey.counts();
    std::string text = options_.heights_text();
    text += fmt::format(
        "served: {} of {} ({:.1f} %): {} on a wall, {} on the roof alone\n", grouped(counts.served()),
        counted(counts.all, "building"),
        100.0 * static_cast<double>(counts.served()) / static_cast<double>(std::max<std::size_t>(1, counts.all)),
        grouped(counts.on_walls), grouped(counts.on_roofs));
    text += fmt::format("not served: {}{}; beyond {:g} m of all masts: {}\n", grouped(counts.unserved),
                        counts.undecided > 0 ? fmt::format("; undecided: {} ({} decides it)", grouped(counts.undecided),
                                                           kDecidesMissingGround)
                                             : "",
                        survey.request.radius, grouped(counts.out_of_reach));
    return text + fmt::format("{}, {}, {}; {}\n{}: open premises.png, or premises.gpkg in a GIS\n",
                              counted(survey.masts.size(), "mast"), counted(survey.statistics.triangles, "triangle"),
                              counted(survey.statistics.lines, "sight line"), survey.request.earth.convention(),
                              options_.directory);
  }

  PremisesOptions options_;
};

}  // namespace

std::unique_ptr<Verb> make_premises_verb() {
  return std::make_unique<PremisesVerb>();
}

}  // namespace itin::cli
