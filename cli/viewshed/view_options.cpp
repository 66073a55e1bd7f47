#include "viewshed/view_options.hpp"

#include <string_view>

#include <itin/error.hpp>
#include <viewshed/result_raster.hpp>

#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void ViewOptions::declare_view(CLI::App& app) {
  observers_.declare(app);
  targets_.declare(app);
  begin_group(app, "What each cell has");
  app.add_option(
         "--mode", mode_text_,
         "One of these:\n"
         "visible - whether any observer sees it (default)\n"
         "certified - certainly visible, certainly hidden, or undecided at this tolerance\n"
         "count - how many observers see it\n"
         "which - one bit for each observer, in UInt32 bands of 32\n"
         "nearest - two bands: distance and number of the nearest observer that sees it\n"
         "angle - elevation angle of the sight line in degrees, the greatest of several observers; at an observer's "
         "own place -90 or 90, and 0 at the height of its eye\n"
         "height - the least height above the ground at which a target is seen, metres; no value where none is or is "
         "known\n"
         "blocker - two bands: theme and feature of what first hides it from the nearest observer; none where the "
         "target itself is below the ground, 4294967294 where ground without data comes first\n"
         "probability - two bands: the probability of being visible under --vertical-error, and 1, 0 or 2 for "
         "visible, hidden or undecided as the heights are stored")
      ->type_name("MODE");
  app.add_option("--vertical-error", sigma_text_, "Standard deviation of heights, for --mode probability")
      ->type_name("METRES");
  app.add_option("--error-correlation", correlation_text_,
                 "L: errors x apart are correlated as exp(-x / L) (default: 0, independent)")
      ->type_name("METRES");
}

void ViewOptions::declare_surface(CLI::App& app) {
  radio_.declare(app);
  detail_.declare(app, "the observer");
  themes_.declare(app);
  foliage_.declare(app);
  earth_.declare(app);
  nodata_.declare(app);
  app.add_flag("--precise", precise_, "Exact for the full surface: the same as --tolerance 0");
  engine_.declare(app);
}

void ViewOptions::validate() {
  observers_.validate();
  targets_.validate(observers_, request_);
  detail_.validate();
  themes_.validate();
  earth_.validate();
  request_.earth = earth_.earth();
  request_.engine = engine_.engine();
  radio_.validate();
  if (!mode_text_.empty()) parse_mode();
  if (radio_.is_given()) radio_.complete(request_);
  request_.nodata = nodata_.rule();
  validate_vertical_error();
  validate_precise();
  validate_foliage();
}

void ViewOptions::validate_foliage() {
  foliage_.validate();
  if (foliage_.given() && (certified_ || request_.mode != viewshed::Mode::kVisible))
    throw InputError("--foliage sees through woods in mode visible alone: leave out --mode and --frequency");
}

void ViewOptions::parse_mode() {
  if (radio_.is_given())
    throw InputError("--frequency judges Fresnel zones, or losses with --loss, and nothing else: leave out --mode");
  // The modes of radio have options of their own.
  const auto modes = viewshed::modes_of_sight();
  std::vector<std::string_view> choices(modes.begin(), modes.end());
  choices.emplace_back("certified");  // the name by which certificates tell the visible
  const std::size_t mode = parse_choice("--mode", mode_text_, choices);
  certified_ = choices[mode] == "certified";
  request_.mode = certified_ ? viewshed::Mode::kVisible : static_cast<viewshed::Mode>(mode);
}

void ViewOptions::validate_vertical_error() {
  const bool wanted = request_.mode == viewshed::Mode::kProbability;
  if (wanted != !sigma_text_.empty())
    throw InputError("--mode probability and --vertical-error METRES need each other; give both");
  if (!wanted && !correlation_text_.empty()) throw InputError("--error-correlation works only with --vertical-error");
  viewshed::VerticalError& error = request_.vertical_error;
  if (wanted) error.sigma = parse_number("--vertical-error", sigma_text_, Range::kPositive);
  if (!correlation_text_.empty())
    error.correlation_length = parse_number("--error-correlation", correlation_text_, Range::kNotNegative);
}

void ViewOptions::validate_precise() {
  const bool exact = !certified_ && !detail_.has_rings() && detail_.detail({}).coarsest() == 0;
  if (precise_ && certified_)
    throw InputError("--precise is exact, and --mode certified says what a tolerance leaves open: give one of the two");
  if (precise_ && !exact)
    throw InputError("--precise is exact for the full surface: leave out --tolerance and --rings");
  precise_ = exact;
}

const viewshed::Request& ViewOptions::complete(const Store& store, std::vector<std::string>& warnings,
                                               Progress& progress) {
  const StoreMetadata& metadata = store.metadata();
  themes_.complete(store, progress);
  request_.themes = themes_.choice();
  earth_.take_body_of(metadata);
  request_.earth = earth_.earth();
  targets_.complete(metadata, request_);
  request_.observers = observers_.observers(metadata, request_, targets_.height_given(), warnings);
  if (detail_.has_rings() && request_.observers.size() > 1)
    throw InputError("--rings lie about one observer; for several give --tolerance");
  request_.detail = detail_.detail(request_.observers.front().position);
  return request_;
}

Document ViewOptions::observer_parameters() const {
  Document parameters{{"observers", observers_document(request_.observers)}};
  parameters.update(observers_.parameters());
  return parameters;
}

Document ViewOptions::parameters() const {
  Document parameters{{"mode", viewshed::mode_name(request_.mode, certified_)}, {"precise", precise_}};
  parameters.update(targets_.parameters(request_));
  if (request_.mode == viewshed::Mode::kProbability) {
    parameters["vertical_error_m"] = request_.vertical_error.sigma;
    parameters["error_correlation_m"] = request_.vertical_error.correlation_length;
  }
  parameters.update(radio_.parameters());
  parameters["observer_on"] = request_.observers_on_surface ? "surface" : "ground";
  parameters.update(detail_.parameters());
  parameters.update(themes_.parameters());
  parameters.update(foliage_.parameters());
  parameters["nodata"] = nodata_.text();
  return parameters;
}

}  // namespace itin::cli
