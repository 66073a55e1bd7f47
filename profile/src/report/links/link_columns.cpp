#include "report/links/link_columns.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "lines/magnetic_azimuth.hpp"
#include "report/links/budget_columns.hpp"

namespace itin::profile {

namespace {

std::optional<double> finite(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// Fills in values that need longitude and latitude.
void add_directions(LinkRow& row, const std::optional<LinkCourse>& course, const LinkQuery& query) {
  if (row.found() == nullptr || !course) return;
  const Link& link = *row.link;
  const EndGrounds& ground = row.result->stands_on;
  row.course = course;
  row.from_declination_deg = declination_on(query.day, course->from, ground.from_m + link.from_height);
  row.to_declination_deg = declination_on(query.day, course->to, ground.to_m + link.to_height);
}

const char* name_of_path(const Reflection& reflection) {
  if (!reflection.ground_m) return "unknown";
  return reflection.screen ? "screened" : "clear";
}

/// The criteria of all links, in the order in which they come.
std::vector<Criterion> criteria_of(const std::vector<LinkRow>& rows) {
  std::vector<Criterion> all;
  for (const LinkRow& row : rows) {
    if (row.found() == nullptr) continue;
    for (const CriterionResult& c : row.found()->criteria)
      if (std::find(all.begin(), all.end(), c.criterion) == all.end()) all.push_back(c.criterion);
  }
  return all;
}

bool any(const std::vector<LinkRow>& rows, const std::function<bool(const LinkRow&)>& holds) {
  return std::any_of(rows.begin(), rows.end(), holds);
}

/// Returns the format of a column's numbers in CSV: the decimals that mean something in the unit that its name ends in.
const char* number_of(std::string_view column) {
  constexpr std::pair<std::string_view, const char*> kNumbers[] = {
      {"_m", "{:.3f}"},  {"_deg", "{:.4f}"},      {"_db", "{:.2f}"},      {"_dbm", "{:.2f}"},     {"_dbi", "{:.2f}"},
      {"_f1", "{:.4f}"}, {"_fraction", "{:.4f}"}, {"_percent", "{:.8g}"}, {"_minutes", "{:.5g}"}, {"_km", "{:.3f}"}};
  for (const auto& [unit, number] : kNumbers)
    if (column.ends_with(unit)) return number;
  return "{}";
}

/// Builds the list of columns. Columns that the contract names come first, in its order.
class ColumnList {
 public:
  ColumnList(const LinkSurvey& survey, const std::vector<LinkRow>& rows) : survey_(survey), rows_(rows) {}

  std::vector<LinkColumn> build() {
    radio_ = any(rows_, [](const LinkRow& r) { return r.result != nullptr && r.result->radio.has_value(); });
    add_verdict();
    if (radio_) add_fresnel();
    if (survey_.query.object) add_object();
    if (any(rows_, [](const LinkRow& r) { return r.found() == nullptr; }))
      columns_.emplace_back("message", [](const LinkRow& r) { return r.message; });
    of_geodesic("geodesic_distance_m", &LinkCourse::distance_m);
    of_result("gap_m", &LinkResult::gap_m);
    add_ends();
    add_tightest();
    if (radio_) add_radio();
    const BudgetQuery& budget = survey_.query.budget;
    add_budget_columns(rows_, budget.from_antenna.pattern || budget.to_antenna.pattern, columns_);
    const std::vector<Criterion> criteria = criteria_of(rows_);
    for (const Criterion& c : criteria) add_criterion(c);
    if (radio_ || !criteria.empty()) add_required("line_of_sight", [](const LinkRow&) { return std::size_t{0}; });
    if (radio_) {
      add_required("0.6_f1", [](const LinkRow& r) -> std::optional<std::size_t> {
        return r.result->radio ? std::optional<std::size_t>(1) : std::nullopt;
      });
    }
    for (const Criterion& c : criteria) add_required(name_of_criterion(c), place_of(c));
    for (LinkColumn& column : columns_) column.number = number_of(column.name);
    add_others();
    return std::move(columns_);
  }

 private:
  using Place = std::function<std::optional<std::size_t>(const LinkRow&)>;

  /// Fills only rows of links that have been computed.
  template <class Of>
  void of_result(const std::string& name, Of of) {
    columns_.emplace_back(name,
                          [of](const LinkRow& r) { return if_any(r.found() != nullptr ? r.result : nullptr, of); });
  }
  void of_geodesic(const std::string& name, double LinkCourse::*member) {
    columns_.emplace_back(name, [member](const LinkRow& r) { return if_any(r.course, member); });
  }

  void add_verdict() {
    columns_.emplace_back("id", [](const LinkRow& r) { return r.id; });
    of_result("distance_m", &LinkResult::distance_m);
    columns_.emplace_back("verdict", verdict_of);
    of_result("clearance_m", [](const LinkResult& r) { return finite(r.found->least_clearance_m); });
    of_result("critical_m", [](const LinkResult& r) { return distance_to(r.found->lowest); });
  }
  /// Adds the tightest place, which reports call the critical point.
  void add_tightest() {
    of_result("tightest_clearance_m", [](const LinkResult& r) { return finite(r.found->clearance_m); });
    of_result("tightest_m", [](const LinkResult& r) { return distance_to(r.found->critical); });
  }
  static std::optional<double> distance_to(const std::optional<ProfilePoint>& p) {
    return if_any(p, &ProfilePoint::distance_m);
  }
  /// Fills only rows of results that have this part.
  template <class Part, class Of>
  void of_part(const std::string& name, Part part, Of of) {
    of_result(name, [part, of](const LinkResult& r) { return if_any(std::invoke(part, r), of); });
  }
  static const std::optional<FresnelClearance>& fresnel_of(const LinkResult& r) { return r.found->fresnel; }

  void add_fresnel() {
    of_part("fresnel_fraction", fresnel_of, &FresnelClearance::fraction);
    of_part("ld_db", &LinkResult::losses, &PathLosses::ld_db);
  }
  void add_object() {
    const auto add_part = [&](const std::string& name, const auto& part) {
      const auto add = [&](const char* what, double VisiblePart::*member) {
        of_part(name + what, &LinkResult::visible,
                [part, member](const VisibleHeight& seen) { return if_any(part(seen), member); });
      };
      add("_visible_m", &VisiblePart::visible_m);
      add("_fraction", &VisiblePart::fraction);
    };
    of_part("hidden_below_m", &LinkResult::visible, &VisibleHeight::from_m);
    add_part("hub", [](const VisibleHeight& seen) { return seen.hub; });
    add_part("tip", [](const VisibleHeight& seen) { return std::optional(seen.tip); });
  }
  void add_ends() {
    of_result("known_verdict", [](const LinkResult& r) { return name_of(r.found->known_verdict); });
    const auto named = [](const LinkRow& r) {
      return r.link != nullptr && !(r.link->from_name + r.link->to_name).empty();
    };
    if (any(rows_, named)) {
      const auto name_at = [](std::string Link::*end) {
        return [end](const LinkRow& r) { return if_any(r.link, end); };
      };
      columns_.emplace_back("name1", name_at(&Link::from_name));
      columns_.emplace_back("name2", name_at(&Link::to_name));
    }
    of_result(survey_.query.from_on_surface ? "stands_on1_m" : "ground1_m",
              [](const LinkResult& r) { return r.stands_on.from_m; });
    of_result(survey_.query.to_on_surface ? "stands_on2_m" : "ground2_m",
              [](const LinkResult& r) { return r.stands_on.to_m; });
    for (const bool there : {true, false}) {
      columns_.emplace_back(
          there ? "azimuth_grid1_deg" : "azimuth_grid2_deg", [there](const LinkRow& r) -> std::optional<double> {
            if (r.found() == nullptr) return std::nullopt;
            return there ? grid_azimuth_deg(r.link->from, r.link->to) : grid_azimuth_deg(r.link->to, r.link->from);
          });
      of_geodesic(there ? "azimuth_true1_deg" : "azimuth_true2_deg",
                  there ? &LinkCourse::azimuth_deg : &LinkCourse::back_azimuth_deg);
    }
    if (survey_.query.day) add_magnetic();
  }
  void add_magnetic() {
    const auto of_end = [&](const char* azimuth, const char* declination, double LinkCourse::*from_true,
                            std::optional<double> LinkRow::*of_north) {
      columns_.emplace_back(azimuth, [from_true, of_north](const LinkRow& r) {
        return r.course ? finite(magnetic_azimuth_deg((*r.course).*from_true, r.*of_north)) : std::nullopt;
      });
      columns_.emplace_back(declination, [of_north](const LinkRow& r) { return finite(r.*of_north); });
    };
    of_end("azimuth_magnetic1_deg", "declination1_deg", &LinkCourse::azimuth_deg, &LinkRow::from_declination_deg);
    of_end("azimuth_magnetic2_deg", "declination2_deg", &LinkCourse::back_azimuth_deg, &LinkRow::to_declination_deg);
  }
  void add_radio() {
    of_part("frequency_ghz", &LinkResult::radio, &RadioPath::frequency_ghz);
    of_part("polarisation", &LinkResult::radio,
            [](const RadioPath& path) { return path.polarisation == Polarisation::kVertical ? "v" : "h"; });
    of_part("fresnel_fraction_at_m", fresnel_of, &FresnelClearance::distance_m);
    of_part("free_space_db", &LinkResult::losses, &PathLosses::free_space_db);
    of_part("reflection_m", &LinkResult::reflection, &Reflection::distance_m);
    of_part("reflected_path", &LinkResult::reflection, name_of_path);
  }

  static std::string name_of_criterion(const Criterion& c) {
    return fmt::format("k{}_{:g}_f1", c.fade ? "e" : fmt::format("{:.4g}", c.k), c.fraction);
  }
  static const CriterionResult* result_of(const LinkRow& row, const Criterion& wanted) {
    for (const CriterionResult& c : row.found()->criteria)
      if (c.criterion == wanted) return &c;
    return nullptr;
  }
  void add_criterion(const Criterion& criterion) {
    const std::string name = name_of_criterion(criterion);
    const auto of_criterion = [&](const char* what, auto of) {
      columns_.emplace_back(name + what, [criterion, of](const LinkRow& row) {
        return if_any(row.found() != nullptr ? result_of(row, criterion) : nullptr, of);
      });
    };
    of_criterion("", [](const CriterionResult& c) { return profile::name_of(c.verdict); });
    of_criterion("_clearance_m", [](const CriterionResult& c) { return finite(c.clearance_m); });
    of_criterion("_clearance_f1", [](const CriterionResult& c) { return finite(c.clearance_f1); });
    of_criterion("_margin_m", [](const CriterionResult& c) { return finite(c.margin_m); });
    of_criterion("_margin_at_m", [](const CriterionResult& c) { return finite(c.margin_at_m); });
  }
  /// The place of a criterion's heights among the required heights of a link.
  static Place place_of(const Criterion& criterion) {
    return [criterion](const LinkRow& row) -> std::optional<std::size_t> {
      const CriterionResult* c = result_of(row, criterion);
      if (c == nullptr) return std::nullopt;
      return static_cast<std::size_t>(c - row.found()->criteria.data()) + (row.result->radio ? 2 : 1);
    };
  }
  void add_required(const std::string& name, const Place& place) {
    const auto of = [&](const char* what, std::optional<double> RequiredHeights::*member) {
      columns_.emplace_back("required_" + name + what, [place, member](const LinkRow& row) {
        const auto at = row.found() != nullptr ? place(row) : std::nullopt;
        return at && *at < row.found()->required.size() ? finite(row.found()->required[*at].heights.*member)
                                                        : std::nullopt;
      });
    };
    of("_h1_m", &RequiredHeights::from_alone_m);
    of("_h2_m", &RequiredHeights::to_alone_m);
    of("_both_m", &RequiredHeights::both_equal_m);
  }

  /// Adds the columns of the table that were not understood; a name that is taken gets a mark.
  void add_others() {
    for (std::size_t i = 0; i < survey_.table.other_columns.size(); ++i) {
      std::string name = survey_.table.other_columns[i];
      const auto taken = [&] {
        return name.empty() ||
               std::any_of(columns_.begin(), columns_.end(), [&](const LinkColumn& c) { return c.name == name; });
      };
      while (taken()) name += "_given";
      columns_.emplace_back(name, [i](const LinkRow& r) {
        return r.others != nullptr && i < r.others->size() ? &(*r.others)[i] : nullptr;
      });
    }
  }

  const LinkSurvey& survey_;
  const std::vector<LinkRow>& rows_;
  bool radio_ = false;
  std::vector<LinkColumn> columns_;
};

}  // namespace

std::string verdict_of(const LinkRow& row) {
  return row.found() != nullptr ? name_of(row.found()->verdict) : "error";
}

std::vector<LinkRow> link_rows(const LinkSurvey& survey) {
  std::vector<LinkRow> rows;
  rows.reserve(survey.results.size() + survey.table.bad.size());
  auto bad = survey.table.bad.begin();
  for (std::size_t row = 1, i = 0; i < survey.results.size() || bad != survey.table.bad.end(); ++row) {
    if (bad != survey.table.bad.end() && bad->row == row) {
      rows.push_back({bad->id, nullptr, nullptr, fmt::format("{}: {}", bad->place, bad->message), &bad->others});
      ++bad;
      continue;
    }
    const Link& link = survey.table.links[i];
    const LinkResult& result = survey.results[i];
    rows.push_back({link.id, &link, &result, result.message, &link.others});
    if (i < survey.budgets.size() && survey.budgets[i]) rows.back().budget = &*survey.budgets[i];
    add_directions(rows.back(), survey.courses[i], survey.query);
    ++i;
  }
  return rows;
}

std::vector<LinkColumn> link_columns(const LinkSurvey& survey, const std::vector<LinkRow>& rows) {
  return ColumnList(survey, rows).build();
}

}  // namespace itin::profile
