// itin profile: the surface along a line or a path.

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/cross_section.hpp>
#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/paths.hpp>
#include <itin/store.hpp>
#include <itin/store_scale.hpp>
#include <itin/tin_export.hpp>
#include <profile/documents.hpp>
#include <profile/foliage_text.hpp>
#include <profile/path_profiles.hpp>

#include "options/foliage_options.hpp"
#include "options/memory_option.hpp"
#include "options/picture_options.hpp"
#include "options/places/in_crs.hpp"
#include "options/places/off_the_data.hpp"
#include "options/surface_options.hpp"
#include "output/output_path.hpp"
#include "output/store_document.hpp"
#include "output/tin_export_options.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"

namespace itin::cli {

namespace {

bool is_text(const std::string& path) {
  return ending_of(path) == ".txt";
}

/// Whether an output shows the ground under features, too.
bool shows_ground(const std::string& path) {
  const std::string ending = ending_of(path);
  return is_text(path) || ending == ".svg" || ending == ".pdf" || ending == ".png";
}

class ProfileVerb final : public Verb {
 public:
  std::string name() const override { return "profile"; }
  std::string summary() const override { return "Write the cross-section of the surface along a line or a path"; }

  void declare(CLI::App& app) override {
    reads(app.add_option("STORE", store_, "The store")->required());
    begin_group(app, "The line");
    app.add_option("--from", from_text_, "Where the line begins")->type_name("x,y");
    const auto repeated = [](CLI::Option* option) {
      return option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    };
    repeated(app.add_option("--via", via_text_, "A corner on the way; may be given again")->type_name("x,y"));
    app.add_option("--to", to_text_, "Where it ends")->type_name("x,y");
    reads(app.add_option("--path", path_, "Follow the one line of this vector file instead")->type_name("FILE"));
    in_crs_.declare(app);
    begin_group(app, kSurface);
    repeated(app.add_option("--tolerance", tolerance_texts_,
                            "Vertical tolerance of the surface; 0: every stored point (default: 0); may be given again "
                            "for several profiles side by side")
                 ->type_name("METRES"));
    app.add_option(
           "--rings", rings_text_,
           "Tolerances that grow with the distance from --from, nearest ring first; features are thinned with the "
           "terrain")
        ->type_name("RADIUS:TOLERANCE,...");
    begin_group(app, kOutputs);
    repeated(writes(
        app.add_option(
               "-o,--output", outputs_,
               "What to write: .csv, .json, .geojson, a chart: .svg, .pdf, .png, or text for other programs: .txt, "
               "distance km, ground m, height of what stands there m, its kind (T vegetation, B anything "
               "else, N nothing); may be given again")
            ->type_name("FILE")));
    writes(app.add_option("--triangles", triangles_, "Write the triangles that the line crosses, as itin tin does")
               ->type_name("FILE"));
    picture_.declare(app, "the triangles that the line crosses");
    themes_.declare(app);
    foliage_.declare_of_paths(app);
    memory_.declare(app, kKeptOfTheStore);
    policy_.declare(app);
  }

  void validate() override {
    const bool line = !from_text_.empty() || !to_text_.empty() || !via_text_.empty();
    if (line && !path_.empty()) throw InputError("--path takes the place of --from, --via and --to");
    if (path_.empty() && (from_text_.empty() || to_text_.empty())) throw InputError("give --from and --to, or --path");
    if (path_.empty()) {
      given_.push_back(parse_place("--from", from_text_));
      for (const std::string& text : via_text_) given_.push_back(parse_place("--via", text));
      given_.push_back(parse_place("--to", to_text_));
    }
    if (!tolerance_texts_.empty() && !rings_text_.empty()) {
      throw InputError("--tolerance and --rings exclude each other");
    }
    for (const std::string& text : tolerance_texts_) {
      for (const double t : parse_numbers("--tolerance", text, Range::kNotNegative)) tolerances_.push_back(t);
    }
    if (!rings_text_.empty()) rings_ = parse_rings("--rings", rings_text_);
    if (tolerances_.empty()) tolerances_.push_back(0);
    for (const std::string& output : outputs_) profile::require_profile_format(output);
    const auto text = std::find_if(outputs_.begin(), outputs_.end(), is_text);
    if (text != outputs_.end() && tolerances_.size() > 1)
      throw InputError(fmt::format("-o '{}': a .txt holds one profile; give one --tolerance", *text));
    if (wants_triangles() && tolerances_.size() > 1)
      throw InputError(
          "--triangles, --image: profiles of several tolerances cross different triangles; give one --tolerance");
    picture_.validate();
    themes_.validate();
    foliage_.validate();
    memory_.bytes();
  }

  Document parameters() const override {
    Document parameters{{"store", store_}};
    if (path_.empty()) {
      parameters["points"] = Document::array();
      for (const Place& p : given_) parameters["points"].push_back({p.position.x, p.position.y});
    } else {
      parameters["path"] = path_;
    }
    if (!in_crs_.crs.empty()) parameters["in_crs"] = in_crs_.crs;
    if (rings_.empty()) {
      parameters["tolerances_m"] = tolerances_;
    } else {
      for (const Ring& ring : rings_) {
        parameters["rings"].push_back({{"radius_m", ring.radius}, {"tolerance_m", ring.tolerance}});
      }
    }
    parameters.update(themes_.parameters());
    parameters.update(foliage_.parameters());
    return parameters;
  }

  Result execute(Progress& progress) override {
    for (const std::string& output : outputs()) policy_.require_writable(output);
    if (!triangles_.empty()) require_tin_output(triangles_, policy_.overwrite);
    const Store store(store_, cache_within(memory_.bytes()));
    for (const std::string& output : outputs_) profile::require_profile_crs(output, store.metadata().crs_wkt);
    themes_.complete(store, progress);
    Result result;
    const std::vector<Point2> corners = corners_in(store.metadata(), result.warnings);
    const profile::PathProfiles along = profile::profiles_along(store, query(corners), progress);
    if (along.profiles.front().profile.points.empty()) {
      result.warnings.push_back("the line lies wholly outside the data; the profile is empty" +
                                where_it_begins(store.metadata()));
    }
    for (const std::string& output : outputs_) profile::require_profile_output(along, output);
    warn_of_grid(store.metadata(), result.warnings);
    result.document = profile::profile_document(store.metadata(), themes_.choice(), along.profiles);
    if (!outputs().empty()) result.document["outputs"] = outputs();
    result.document["statistics"] = statistics_document(along.statistics, along.triangles);
    write(along, result.document);
    if (wants_triangles()) write_triangles(store, corners, along.query.details.front(), progress);
    result.text = text(along);
    return result;
  }

 private:
  std::vector<Point2> corners_in(const StoreMetadata& metadata, std::vector<std::string>& warnings) const {
    if (!path_.empty()) {
      const std::vector<Path> paths = read_paths(path_, metadata.crs_wkt, warnings);
      if (paths.size() != 1)
        throw FileError(path_, fmt::format("has {}; a profile follows one", counted(paths.size(), "line")));
      return paths.front().corners;
    }
    std::vector<Point2> corners;
    for (const Place& p : given_) corners.push_back(in_crs_.of(p).transform_to(metadata.crs_wkt)(p.position));
    return without_repeats(std::move(corners));
  }

  std::string where_it_begins(const StoreMetadata& metadata) const {
    if (given_.empty()) return fmt::format("; the data is {}", extent_of(metadata));
    const auto off = off_the_data(given_.front().position, in_crs_.of(given_.front()), metadata);
    return off ? fmt::format("; --from '{}' {}", from_text_, *off) : "";
  }

  profile::PathQuery query(const std::vector<Point2>& corners) const {
    profile::PathQuery query{.corners = corners, .details = {}, .themes = themes_.choice()};
    query.with_ground = std::any_of(outputs_.begin(), outputs_.end(), shows_ground);
    if (foliage_.given()) query.foliage = foliage_.foliage();
    for (const double t : tolerances_) query.details.push_back(Detail::tolerance(t));
    if (rings_.empty()) return query;
    query.details = {Detail::rings(corners.front(), rings_)};
    query.names = {"rings " + rings_text_};
    return query;
  }

  std::vector<std::string> outputs() const {
    std::vector<std::string> paths = outputs_;
    for (const std::string& path : {triangles_, picture_.path()})
      if (!path.empty()) paths.push_back(path);
    return paths;
  }
  bool wants_triangles() const { return !triangles_.empty() || !picture_.path().empty(); }

  void write_triangles(const Store& store, const std::vector<Point2>& corners, const Detail& detail,
                       Progress& progress) const {
    const Tin crossed = triangles_along(store, corners, detail, themes_.choice(), progress);
    if (!picture_.path().empty()) picture_.write(store, crossed, detail, policy_.overwrite, progress);
    if (triangles_.empty()) return;
    const auto options = tin_export_options(store.metadata(), {{"command", parameters()}}, policy_.overwrite);
    export_tin(crossed, triangles_, options, progress);
  }

  void write(const profile::PathProfiles& along, const Document& found) const {
    Document document = call_document(*this);
    document.update(found);
    document.erase("outputs");
    const std::string json = json_text(document, 2) + "\n";
    for (const std::string& output : outputs_)
      profile::write_profiles(along, output, {.json = json, .overwrite = policy_.overwrite});
  }

  std::string text(const profile::PathProfiles& along) const {
    std::string text;
    for (const profile::SurfaceProfile& surface : along.profiles) {
      const auto& points = surface.profile.points;
      const auto [low, high] = std::minmax_element(
          points.begin(), points.end(), [](const auto& a, const auto& b) { return a.ground_m < b.ground_m; });
      text +=
          fmt::format("{}: {:.2f} m, {}", surface.name, surface.profile.length_m, counted(points.size(), "breakpoint"));
      if (!points.empty()) text += fmt::format(", {:.2f} to {:.2f} m", low->ground_m, high->ground_m);
      for (const auto& [from, to] : surface.profile.gaps) text += fmt::format(", no data {:.2f} to {:.2f} m", from, to);
      if (surface.foliage) text += "; " + profile::foliage_text(*surface.foliage);
      text += "\n";
    }
    for (const std::string& output : outputs()) text += output + "\n";
    return text + fmt::format("read {} in {}\n", counted(along.statistics.points_read, "point"),
                              counted(along.statistics.blocks_read, "block"));
  }

  std::string store_, from_text_, to_text_, path_, rings_text_, triangles_;
  std::vector<std::string> via_text_, tolerance_texts_, outputs_;
  std::vector<Place> given_;
  std::vector<double> tolerances_;
  std::vector<Ring> rings_;
  InCrs in_crs_;
  PictureOptions picture_;
  ThemeOptions themes_;
  FoliageOptions foliage_;
  MemoryOption memory_;
  OutputPolicy policy_;
};

}  // namespace

std::unique_ptr<Verb> make_profile_verb() {
  return std::make_unique<ProfileVerb>();
}

}  // namespace itin::cli
