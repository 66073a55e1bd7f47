// Profiles, lines of sight and links over a store.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <profile/links.hpp>
#include <profile/los.hpp>
#include <profile/path_profiles.hpp>
#include <viewshed/map_image.hpp>

#include "arguments.hpp"
#include "arrays.hpp"
#include "call.hpp"
#include "module.hpp"
#include "shared_store.hpp"

namespace itin::python {

namespace {

using profile::SightVerdict;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The codes of verdicts in rasters; 255 stands for a link that could not be computed.
std::uint8_t code_of(SightVerdict verdict) {
  return verdict == SightVerdict::kVisible ? 1 : verdict == SightVerdict::kHidden ? 0 : 2;
}
constexpr std::uint8_t kError = 255;

/// Reads `frequency_ghz`, `polarisation` and `over_sea`; nothing without a frequency.
std::optional<RadioPath> radio_of(const py::dict& fields, const Earth& earth) {
  if (!fields.contains("frequency_ghz")) return std::nullopt;
  RadioPath path;
  take(fields, "frequency_ghz", path.frequency_ghz);
  take(fields, "over_sea", path.over_sea);
  path.polarisation = polarisation_of(fields);
  path.effective_earth_km = effective_earth_km(earth);
  return path;
}

std::vector<profile::Criterion> criteria_of(const py::dict& fields) {
  std::vector<std::pair<double, double>> given;
  take(fields, "criteria", given);
  std::vector<profile::Criterion> criteria;
  for (const auto& [k, fraction] : given) criteria.push_back({k, fraction});
  return criteria;
}

// Profiles.

/// Returns length, distance, x, y, z, theme, and gaps (n, 2).
py::tuple arrays_of(const profile::Profile& profile) {
  std::vector<double> distance, x, y, z, gaps;
  std::vector<std::uint16_t> theme;
  for (const profile::ProfilePoint& p : profile.points) {
    distance.push_back(p.distance_m), x.push_back(p.x), y.push_back(p.y), z.push_back(p.ground_m);
    theme.push_back(p.theme);
  }
  for (const auto& [from, to] : profile.gaps) gaps.insert(gaps.end(), {from, to});
  const auto count = static_cast<py::ssize_t>(profile.gaps.size());
  return py::make_tuple(profile.length_m, array_of(std::move(distance)), array_of(std::move(x)), array_of(std::move(y)),
                        array_of(std::move(z)), array_of(std::move(theme)), array_of(std::move(gaps), {count, 2}));
}

profile::PathProfiles profile_along(const Store& store, const Numbers& corners, const py::dict& fields,
                                    const py::object& show) {
  profile::PathQuery query{.corners = points_of(corners, "corners"),
                           .details = {detail_of(fields)},
                           .themes = themes_of(fields),
                           .foliage = foliage_of(fields)};
  const LeftOut left_out(fields);
  return result_of(show, [&](Progress& progress) {
    left_out.leave(store, query.themes, progress);
    return profile::profiles_along(store, query, progress);
  });
}

/// Returns the length of foliage and the share of the light that would come along it; None where it was not asked for.
py::object foliage_of_path(const profile::PathProfiles& path) {
  const auto& foliage = path.profiles.front().foliage;
  if (!foliage) return py::none();
  return py::make_tuple(foliage->length_m, foliage->transmittance);
}

void write_profile(const profile::PathProfiles& path, const std::string& file, bool overwrite) {
  profile::require_profile_output(path, file);
  run(py::none(), [&](Progress&) { profile::write_profiles(path, file, {.overwrite = overwrite}); });
}

// Lines of sight.

struct LineOfSight {
  SharedStore store;
  profile::StoreLine line;
  profile::LosReport report;
  // Where woods are seen through:
  std::optional<profile::Foliage> foliage = {};
  std::optional<profile::FoliageSight> sight = {};

  std::string json() const {
    return sight ? profile::json_of(*store, line, *sight, *foliage) : profile::json_of(*store, line, report);
  }
};

profile::StoreLine line_of(const Point3& from, const Point3& to, const py::dict& fields) {
  profile::StoreLine line{
      .from = {from.x, from.y}, .to = {to.x, to.y}, .detail = detail_of(fields), .themes = themes_of(fields)};
  take(fields, "from_is_elevation", line.from_is_elevation);
  take(fields, "to_is_elevation", line.to_is_elevation);
  return line;
}

profile::LosQuery query_of(const Store& store, const Point3& from, const Point3& to, const py::dict& fields) {
  profile::LosQuery query;
  query.from_height_m = from.z, query.to_height_m = to.z;
  query.earth = earth_of(fields, store.metadata().crs_wkt);
  query.radio = radio_of(fields, query.earth);
  query.budget = budget_of(fields);
  query.criteria = criteria_of(fields);
  query.nodata = nodata_of(fields);
  take(fields, "from_on_surface", query.from_on_surface);
  take(fields, "to_on_surface", query.to_on_surface);
  return query;
}

std::shared_ptr<LineOfSight> line_of_sight(const SharedStore& store, const Numbers& ends, const py::dict& fields,
                                           const py::object& show) {
  const std::vector<Point3> places = places_of(ends, "from");
  profile::StoreLine line = line_of(places.front(), places.back(), fields);
  const profile::LosQuery query = query_of(*store, places.front(), places.back(), fields);
  const LeftOut left_out(fields);
  const std::optional<profile::Foliage> foliage = foliage_of(fields);
  return result_of(show, [&](Progress& progress) {
    left_out.leave(*store, line.themes, progress);
    if (!foliage) return std::make_shared<LineOfSight>(LineOfSight{store, line, profile::analyse(*store, line, query)});
    profile::FoliageSight sight = profile::through_foliage(*store, line, query, *foliage);
    profile::LosReport report = profile::report_through(sight, *foliage);
    return std::make_shared<LineOfSight>(LineOfSight{store, line, std::move(report), foliage, std::move(sight)});
  });
}

/// Returns the metres of foliage on the line and the share of the light that comes through; None where woods are solid.
py::object foliage_of_line(const LineOfSight& line) {
  if (!line.sight) return py::none();
  return py::make_tuple(line.sight->length_m, line.sight->transmittance);
}

void write_line(const LineOfSight& line, const std::string& path, bool overwrite) {
  profile::require_report(line.report, path);
  run(py::none(), [&](Progress& progress) {
    profile::LosReport report = line.report;
    if (profile::shows_location(path))
      report.location = viewshed::location_map(*line.store, report, {.themes = line.line.themes}, progress);
    profile::write_report(report, line.json(), path, overwrite);
  });
}

// Links.

/// The columns of many links, filled batch by batch: what a link takes besides these is not kept.
struct LinkColumns {
  std::vector<std::uint8_t> verdict;
  std::vector<double> distance, clearance, critical, fresnel, loss, free_space, gap;
  std::map<std::size_t, std::string> messages;  ///< by the number of the link

  void add(const profile::LinkResult& link) {
    if (!link.message.empty()) messages.emplace(verdict.size(), link.message);
    const auto& found = link.found;
    verdict.push_back(found ? code_of(found->verdict) : kError);
    distance.push_back(link.distance_m);
    clearance.push_back(found ? found->least_clearance_m.value_or(kNone) : kNone);
    critical.push_back(found && found->critical ? found->critical->distance_m : kNone);
    fresnel.push_back(found && found->fresnel ? found->fresnel->fraction : kNone);
    loss.push_back(link.losses ? link.losses->ld_db : kNone);
    free_space.push_back(link.losses ? link.losses->free_space_db : kNone);
    gap.push_back(link.gap_m);
  }
};

constexpr std::size_t kBatch = 65536;

/// The part of a call's progress that a batch has.
class BatchProgress final : public Progress {
 public:
  BatchProgress(Progress& whole, double from, double share) : whole_(whole), from_(from), share_(share) {}
  void report(std::string_view stage, double fraction) override { whole_.report(stage, from_ + share_ * fraction); }
  bool cancelled() const override { return whole_.cancelled(); }

 private:
  Progress& whole_;
  double from_, share_;
};

LinkColumns survey(const Store& store, const std::vector<Point3>& from, const std::vector<Point3>& to,
                   const profile::LinkQuery& query, Progress& progress) {
  LinkColumns columns;
  for (std::size_t first = 0; first < from.size(); first += kBatch) {
    const std::size_t last = std::min(first + kBatch, from.size());
    std::vector<profile::Link> links;
    links.reserve(last - first);
    for (std::size_t i = first; i < last; ++i)
      links.push_back({"", {from[i].x, from[i].y}, from[i].z, {to[i].x, to[i].y}, to[i].z});
    const auto all = static_cast<double>(from.size());
    BatchProgress batch(progress, static_cast<double>(first) / all, static_cast<double>(last - first) / all);
    for (const profile::LinkResult& link : survey_links(store, links, query, batch)) columns.add(link);
  }
  return columns;
}

profile::LinkQuery link_query(const Store& store, const py::dict& fields) {
  profile::LinkQuery query;
  query.earth = earth_of(fields, store.metadata().crs_wkt);
  query.detail = detail_of(fields);
  query.themes = themes_of(fields);
  query.radio = radio_of(fields, query.earth);
  query.budget = budget_of(fields);
  query.criteria = criteria_of(fields);
  query.nodata = nodata_of(fields);
  take(fields, "from_on_surface", query.from_on_surface);
  take(fields, "to_on_surface", query.to_on_surface);
  return query;
}

py::tuple links(const Store& store, const Numbers& from_ends, const Numbers& to_ends, const py::dict& fields,
                const py::object& show) {
  const std::vector<Point3> from = places_of(from_ends, "from"), to = places_of(to_ends, "to");
  if (from.size() != to.size()) throw InputError("`to`: give as many ends as in `from`", "to");
  profile::LinkQuery query = link_query(store, fields);
  const LeftOut left_out(fields);
  LinkColumns c = result_of(show, [&](Progress& progress) {
    left_out.leave(store, query.themes, progress);
    return survey(store, from, to, query, progress);
  });
  return py::make_tuple(array_of(std::move(c.verdict)), array_of(std::move(c.distance)),
                        array_of(std::move(c.clearance)), array_of(std::move(c.critical)),
                        array_of(std::move(c.fresnel)), array_of(std::move(c.loss)), array_of(std::move(c.free_space)),
                        array_of(std::move(c.gap)), py::cast(c.messages));
}

/// Judges a table of links and writes it as `itin los --links` does. Returns how many links are visible, hidden,
/// undecided and errors, and the warnings.
py::tuple link_table(const Store& store, const std::string& path, const std::vector<std::string>& outputs,
                     const py::dict& fields, const py::object& show) {
  std::pair<double, double> heights{2, 2};
  std::string crs;
  profile::LinkFileOptions options;
  profile::LinkChoice choice;
  take(fields, "heights", heights), take(fields, "crs", crs), take(fields, "overwrite", options.overwrite);
  take(fields, "layer", choice.layer), take(fields, "where", choice.where);
  for (const std::string& output : outputs) profile::require_link_format(output);
  profile::LinkQuery query = link_query(store, fields);
  const LeftOut left_out(fields);
  const profile::LinkSurvey survey = result_of(show, [&](Progress& progress) {
    left_out.leave(store, query.themes, progress);
    auto table = profile::read_link_table(path, store.metadata().crs_wkt, {heights.first, heights.second}, crs, choice);
    auto judged = profile::survey_link_table(store, std::move(table), query, progress);
    if (std::any_of(outputs.begin(), outputs.end(), profile::shows_location))
      options.map = viewshed::links_map(store, judged, options.title, progress);
    profile::write_link_table(judged, outputs, options);
    return judged;
  });
  const profile::LinkCounts counts = profile::counts_of(survey);
  return py::make_tuple(counts.visible, counts.hidden, counts.undecided, counts.error,
                        py::tuple(py::cast(survey.warnings)));
}

}  // namespace

void bind_lines(py::module_& module) {
  py::class_<profile::PathProfiles>(module, "PathProfiles")
      .def_property_readonly("profile",
                             [](const profile::PathProfiles& path) { return arrays_of(path.profiles.front().profile); })
      .def_property_readonly("foliage", &foliage_of_path)
      .def("write", &write_profile);
  py::class_<LineOfSight, std::shared_ptr<LineOfSight>>(module, "LineOfSight")
      .def_property_readonly("verdict", [](const LineOfSight& l) { return code_of(l.report.verdict); })
      .def_property_readonly("distance", [](const LineOfSight& l) { return l.report.profile.length_m; })
      .def_property_readonly("clearance", [](const LineOfSight& l) { return l.report.least_clearance_m; })
      .def_property_readonly("profile", [](const LineOfSight& l) { return arrays_of(l.report.profile); })
      .def_property_readonly("foliage", &foliage_of_line)
      .def_property_readonly("json", &LineOfSight::json)
      .def("write", &write_line);
  store_class(module)
      .def("profile", &profile_along)
      .def("line_of_sight", &line_of_sight)
      .def("links", &links)
      .def("link_table", &link_table);
}

}  // namespace itin::python
