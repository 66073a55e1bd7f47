#include "los/los_links.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/geodesic.hpp>
#include <itin/output_file.hpp>

#include "options/off_the_data.hpp"
#include "output/csv_cell.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

using profile::Link;
using profile::LinkResult;
using profile::LinkTable;

/// Every digit.
std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

/// The columns behind those that every table has; the last is geodesic_distance_m, which came to them later.
struct Columns {
  bool radio = false, object = false, errors = false;
};

/// Writes one row per row of the file, in its order.
class TableWriter {
 public:
  explicit TableWriter(const Columns& columns) : columns_(columns) {
    text_ = "id,distance_m,verdict,clearance_m,critical_m";
    if (columns.radio) text_ += ",fresnel_fraction,ld_db";
    if (columns.object) text_ += ",hidden_below_m,hub_visible_m,hub_fraction,tip_visible_m,tip_fraction";
    if (columns.errors) text_ += ",message";
    text_ += ",geodesic_distance_m,gap_m\n";
  }

  void add(const std::string& id, const LinkResult& r, const std::optional<double>& geodesic_m) {
    const auto out = std::back_inserter(text_);
    const auto& found = r.found;
    fmt::format_to(out, "{},{},{},{},{}", csv_cell(id), found ? fmt::format("{}", r.distance_m) : "",
                   found ? name_of(found->verdict) : "error", found ? cell(found->clearance_m) : "",
                   found && found->critical ? fmt::format("{}", found->critical->distance_m) : "");
    if (columns_.radio) {
      fmt::format_to(out, ",{},{}", found && found->fresnel ? fmt::format("{}", found->fresnel->fraction) : "",
                     r.losses ? fmt::format("{}", r.losses->ld_db) : "");
    }
    if (columns_.object && r.visible) {
      fmt::format_to(out, ",{},{},{},{},{}", r.visible->from_m, r.visible->hub_visible_m, r.visible->hub_fraction,
                     r.visible->tip_visible_m, r.visible->tip_fraction);
    } else if (columns_.object) {
      text_ += ",,,,,";
    }
    if (columns_.errors) text_ += "," + csv_cell(r.message);
    text_ += "," + cell(geodesic_m) + (found ? fmt::format(",{}\n", r.gap_m) : ",\n");
  }

  const std::string& text() const { return text_; }

 private:
  Columns columns_;
  std::string text_;
};

/// Between a link's ends on WGS 84.
class GeodesicDistance {
 public:
  explicit GeodesicDistance(const std::string& crs_wkt) : to_geographic_(crs_wkt, "EPSG:4326") {}

  std::optional<double> operator()(const profile::Link& link) const {
    try {
      return geodesic(to_geographic_(link.from), to_geographic_(link.to)).distance_m;
    } catch (const InputError&) {
      return std::nullopt;  // an end is no place on the ground
    }
  }

 private:
  CoordinateTransform to_geographic_;
};

std::string table_text(const LinkTable& table, const std::vector<LinkResult>& results, const Columns& columns,
                       const std::string& crs_wkt) {
  const GeodesicDistance geodesic_m(crs_wkt);
  TableWriter writer(columns);
  auto bad = table.bad.begin();
  for (std::size_t row = 1, i = 0; i < results.size() || bad != table.bad.end(); ++row) {
    if (bad != table.bad.end() && bad->row == row) {
      LinkResult error;
      error.message = fmt::format("line {}: {}", bad->line, bad->message);
      writer.add(bad->id, error, std::nullopt);
      ++bad;
    } else {
      writer.add(table.links[i].id, results[i], results[i].found ? geodesic_m(table.links[i]) : std::nullopt);
      ++i;
    }
  }
  return writer.text();
}

struct Counts {
  std::size_t visible = 0, hidden = 0, undecided = 0, error = 0, gaps = 0;
};

Counts counts_of(const LinkTable& table, const std::vector<LinkResult>& results) {
  Counts counts;
  counts.error = table.bad.size();
  for (const LinkResult& r : results) {
    counts.error += !r.found;
    counts.gaps += r.gap_m > 0;
    if (!r.found) continue;
    counts.visible += r.found->verdict == profile::SightVerdict::kVisible;
    counts.hidden += r.found->verdict == profile::SightVerdict::kHidden;
    counts.undecided += r.found->verdict == profile::SightVerdict::kUndecided;
  }
  return counts;
}

/// The first error in rows that cannot be read, else in links.
std::string first_error(const LinkTable& table, const std::vector<LinkResult>& results, const StoreMetadata& metadata) {
  if (!table.bad.empty()) return fmt::format("line {}: {}", table.bad.front().line, table.bad.front().message);
  const auto first = std::find_if(results.begin(), results.end(), [](const LinkResult& r) { return !r.found; });
  const Link& link = table.links[static_cast<std::size_t>(first - results.begin())];
  const bool on = is_on_the_data(link.from, metadata) && is_on_the_data(link.to, metadata);
  return fmt::format("{}: {}{}", link.id, first->message, on ? "" : "; the data is " + extent_of(metadata));
}

}  // namespace

void LosLinks::declare(CLI::App& app) {
  reads(app.add_option("--links", path_,
                       "Many links: a table id,x1,y1,h1,x2,y2,h2 (.csv; also lon1,lat1,lon2,lat2), or a file of lines")
            ->type_name("FILE"));
  app.add_option("--link-height", height_text_,
                 "Height of both ends of the lines of a file (default: 2, and at the second end the tip of "
                 "--visible-height)")
      ->type_name("METRES");
  writes(app.add_option("-o,--output", output_, "With --links: the table to write (.csv)")->type_name("FILE"));
}

void LosLinks::validate(const std::optional<profile::TallObject>& object) {
  if (!output_.ends_with(".csv")) throw InputError(fmt::format("-o '{}': --links writes a table, .csv", output_));
  if (object) heights_.to_m = object->tip_m;
  if (height_text_.empty()) return;
  heights_.from_m = heights_.to_m = parse_height("--link-height", height_text_, Range::kNotNegative);
}

void LosLinks::require_none() const {
  if (!output_.empty())
    throw InputError(fmt::format("-o '{}' is of use with --links; for one line give --report", output_));
  if (!height_text_.empty()) throw InputError("--link-height is of use with --links only");
}

Document LosLinks::parameters() const {
  return {{"links", path_}, {"link_height_m", heights_.from_m}, {"link_height_to_m", heights_.to_m}};
}

LinkTable LosLinks::table(const Store& store, const LosStoreOptions& surface) const {
  return profile::read_link_table(path_, store.metadata().crs_wkt, heights_, surface.in_crs());
}

LosLinks::Survey LosLinks::run(const Store& store, const LinkTable& table, const LosStoreOptions& surface,
                               const profile::LosQuery& query, bool overwrite, Progress& progress) const {
  const StoreMetadata& metadata = store.metadata();
  const std::vector<LinkResult> results = profile::survey_links(store, table.links,
                                                                {.earth = query.earth,
                                                                 .detail = surface.detail(),
                                                                 .themes = surface.themes(),
                                                                 .from_on_surface = surface.from_on_surface(),
                                                                 .to_on_surface = surface.to_on_surface(),
                                                                 .radio = query.radio,
                                                                 .criteria = query.criteria,
                                                                 .object = query.object,
                                                                 .nodata = surface.nodata()},
                                                                progress);
  const Counts counts = counts_of(table, results);
  const Columns columns{query.radio.has_value(), query.object.has_value(), counts.error > 0};
  write_file(output_, table_text(table, results, columns, metadata.crs_wkt), overwrite);
  Survey survey;
  for (const LinkResult& r : results) survey.computed.push_back(r.found.has_value());
  Result& result = survey.result;
  result.document["crs"] = crs_identifier(metadata.crs_wkt);
  result.document["surface"] = surface_document(metadata, surface.detail(), surface.themes());
  result.document["links"] = {
      {"visible", counts.visible}, {"hidden", counts.hidden}, {"undecided", counts.undecided}, {"error", counts.error}};
  result.document["outputs"] = Document::array({output_});
  const std::size_t all = results.size() + table.bad.size();
  result.text = fmt::format("{}: {}, {} visible", output_, counted(all, "link"), grouped(counts.visible));
  if (counts.undecided > 0) result.text += fmt::format(", {} undecided", grouped(counts.undecided));
  result.text += "\n";
  if (counts.gaps > 0 && surface.nodata() != profile::NoData::kClear) {
    result.warnings.push_back(fmt::format(
        "{} of {} cross ground without data, which {}; see --nodata", counts.gaps, counted(all, "link"),
        surface.nodata() == profile::NoData::kBlock ? "counts as blocking"
                                                    : "leaves undecided those that known ground does not hide"));
  }
  if (counts.error > 0)
    result.failure = fmt::format("{}: {} of {} could not be computed; see the column message; the first: {}", output_,
                                 counts.error, counted(all, "link"), first_error(table, results, metadata));
  return survey;
}

}  // namespace itin::cli
