#include "los_links.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/output_file.hpp>

#include "store_document.hpp"
#include "values.hpp"

namespace itin::cli {

namespace {

using profile::Link;
using profile::LinkResult;

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

/// Quoted where it has to be.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string table(const std::vector<Link>& links, const std::vector<LinkResult>& results, bool radio, bool errors) {
  std::string text = "id,distance_m,verdict,clearance_m,critical_m";
  if (radio) text += ",fresnel_fraction,ld_db";
  text += errors ? ",message\n" : "\n";
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < links.size(); ++i) {
    const LinkResult& r = results[i];
    fmt::format_to(out, "{},{},{},{},{}", cell(links[i].id), r.distance_m, r.verdict ? name_of(*r.verdict) : "error",
                   cell(r.clearance_m), cell(r.critical_m));
    if (radio) fmt::format_to(out, ",{},{}", cell(r.fresnel_fraction), cell(r.ld_db));
    if (errors) fmt::format_to(out, ",{}", cell(r.message));
    text += "\n";
  }
  return text;
}

}  // namespace

void LosLinks::declare(CLI::App& app) {
  app.add_option("--links", path_, "Many links: a table id,x1,y1,h1,x2,y2,h2 (.csv), or a file of lines")
      ->type_name("FILE");
  app.add_option("--link-height", height_text_, "Height of both ends of the lines of a file (default: 2)")
      ->type_name("METRES");
  app.add_option("-o,--output", output_, "With --links: the table to write (.csv)")->type_name("FILE");
}

void LosLinks::validate() {
  if (!output_.ends_with(".csv")) throw InputError(fmt::format("-o '{}': --links writes a table, .csv", output_));
  if (!height_text_.empty()) height_ = parse_number("--link-height", height_text_, Range::kNotNegative);
}

Document LosLinks::parameters() const {
  return {{"links", path_}, {"link_height_m", height_}};
}

std::vector<Link> LosLinks::links(const Store& store, const LosStoreOptions& surface) const {
  return profile::read_links(path_, store.metadata().crs_wkt, height_, surface.in_crs());
}

Result LosLinks::run(const Store& store, const std::vector<Link>& links, const LosStoreOptions& surface,
                     const profile::LosQuery& query, bool overwrite, Progress& progress) const {
  const StoreMetadata& metadata = store.metadata();
  const std::vector<LinkResult> results = profile::survey_links(store, links,
                                                                {.earth = query.earth,
                                                                 .detail = surface.detail(),
                                                                 .themes = surface.themes(),
                                                                 .from_on_surface = surface.from_on_surface(),
                                                                 .to_on_surface = surface.to_on_surface(),
                                                                 .radio = query.radio,
                                                                 .gaps_block = surface.gaps_block()},
                                                                progress);
  const auto failed = static_cast<std::size_t>(
      std::count_if(results.begin(), results.end(), [](const LinkResult& r) { return !r.verdict; }));
  const auto visible = static_cast<std::size_t>(std::count_if(results.begin(), results.end(), [](const LinkResult& r) {
    return r.verdict == profile::SightVerdict::kVisible;
  }));
  write_file(output_, table(links, results, query.radio.has_value(), failed > 0), overwrite);
  Result result;
  result.document["crs"] = crs_identifier(metadata.crs_wkt);
  result.document["surface"] = surface_document(metadata, surface.detail(), surface.themes());
  result.document["links"] = {{"visible", visible}, {"hidden", results.size() - visible - failed}, {"error", failed}};
  result.document["outputs"] = Document::array({output_});
  result.text = fmt::format("{}: {} links, {} visible\n", output_, grouped(links.size()), grouped(visible));
  if (failed > 0)
    result.failure =
        fmt::format("{}: {} of {} links could not be computed; see the column message", output_, failed, links.size());
  return result;
}

}  // namespace itin::cli
