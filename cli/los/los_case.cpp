#include "los/los_case.hpp"

#include <fmt/format.h>

#include <itin/celestial_body.hpp>
#include <profile/budget_text.hpp>
#include <profile/documents.hpp>
#include <profile/radio_text.hpp>
#include <profile/report_text.hpp>

namespace itin::cli {

namespace {

/// The unit of the text for people; pages have that of their line.
constexpr auto kMetres = profile::DistanceUnit::kMetres;

void add_radio_fact(profile::LosReport& report) {
  const profile::RadioPath& radio = *report.query.radio;
  report.facts.emplace_back(
      "Radio", fmt::format("{:g} GHz, {} polarisation, effective Earth {:.1f} km, {:.0f} % over sea; wavelength "
                           "0.299792458 / f",
                           radio.frequency_ghz,
                           radio.polarisation == profile::Polarisation::kVertical ? "vertical" : "horizontal",
                           radio.effective_earth_km, 100 * radio.over_sea));
}

void add_facts(profile::LosReport& report) {
  report.facts.emplace_back("Refraction", report.query.earth.convention());
  if (report.query.radio) {
    add_radio_fact(report);
    report.facts.emplace_back(
        "Not considered",
        report.budget ? profile::not_counted_text(*report.budget)
                      : "antenna gains and feeder losses, absorption by gases, rain, multipath and availability");
  }
  report.facts.emplace_back("Program", "itin " ITIN_VERSION);
}

void add_names(const LosHeader& header, profile::LosReport& report) {
  const auto add = [](const std::string& name, std::string& of, std::vector<std::string>& lines) {
    if (!name.empty()) of = name, lines.insert(lines.begin(), name);
  };
  add(header.from_name, report.from_name, report.from_lines);
  add(header.to_name, report.to_name, report.to_lines);
}

void add_names(const LosHeader& header, Document& document) {
  if (!header.from_name.empty()) document["from"]["name"] = header.from_name;
  if (!header.to_name.empty()) document["to"]["name"] = header.to_name;
}

/// Adds what the report says about the call.
void complete(profile::LosReport& report, const LosHeader& header) {
  report.title = header.title;
  report.table_spacing_m = header.table_spacing_m;
  add_facts(report);
  report.facts.insert(report.facts.begin(), header.facts.begin(), header.facts.end());
  add_names(header, report);
}

LosCase los_case(profile::LosReport report, Document document, const LosHeader& header) {
  LosCase one{std::move(report), {}};
  one.result.document = std::move(document);
  add_names(header, one.result.document);
  return one;
}

std::string text_of_findings(const profile::LosReport& report, const profile::LineFindings& found) {
  std::string text;
  for (const profile::Obstruction& o : found.obstructions) {
    text += fmt::format("obstructed from {:.1f} to {:.1f} m, {:.2f} m deep at {:.1f} m ({})\n", o.from_m, o.to_m,
                        o.depth_m, o.peak_at_m, cause_of(report, o.theme, o.feature));
  }
  for (const profile::CriterionResult& c : found.criteria)
    text += fmt::format("K = {}, {:g} F1: {}{}\n", factor_text(c.criterion, c.k), c.criterion.fraction,
                        outcome_text(c, kMetres), least_fraction_text(c, kMetres));
  if (const std::string note = profile::fade_note(found, report.profile.length_m); !note.empty()) text += note + "\n";
  for (const profile::NamedHeights& r : found.required) {
    text +=
        fmt::format("heights needed for {}: {} at the first end alone, or {} at the second end alone, or {} at both\n",
                    r.name, profile::required_text(r.heights.from_alone_m),
                    profile::required_text(r.heights.to_alone_m), profile::required_text(r.heights.both_equal_m));
  }
  return text;
}

}  // namespace

LosCase los_case(profile::LosReport report, const LosHeader& header) {
  complete(report, header);
  Document document = profile::los_document(report);
  return los_case(std::move(report), std::move(document), header);
}

LosCase los_case(const Store& store, LosStoreOptions::Result line, const LosHeader& header) {
  complete(line.report, header);
  Document document = profile::los_document(store.metadata(), line.line, line.report);
  LosCase one = los_case(std::move(line.report), std::move(document), header);
  one.result.warnings = std::move(line.warnings);
  if (!line.foliage.is_null()) one.result.document["foliage"] = std::move(line.foliage);
  one.foliage_text = std::move(line.foliage_text);
  return one;
}

std::string text_of(const profile::LosReport& report) {
  std::string text = fmt::format("{}, {:.1f} m", name_of(report.verdict), report.profile.length_m);
  if (report.critical) {
    text += fmt::format("; clearance {:.2f} m at {:.1f} m ({})", *report.clearance_m, report.critical->distance_m,
                        cause_of(report, report.critical->theme, report.critical->feature));
  }
  text += "\n";
  if (const std::string why = reason_of(report, kMetres); !why.empty()) text += why + "\n";
  if (report.geodesic_m)
    text += fmt::format("{:.1f} m on the grid, {:.1f} m geodesic{}\n", report.profile.length_m, *report.geodesic_m,
                        body_of(report.crs_wkt).is_earth ? " (WGS 84)" : "");
  if (report.bare) text += "with clutter:\n";
  text += text_of_findings(report, report);
  if (report.bare) {
    text += fmt::format("bare ground: {}; clearance {:.2f} m at {:.1f} m\n", name_of(report.bare->verdict),
                        *report.bare->clearance_m, report.bare->critical->distance_m);
    text += text_of_findings(report, *report.bare);
  }
  if (report.losses) {
    const profile::PathLosses& l = *report.losses;
    text += fmt::format("free space {:.1f} dB, diffraction (delta-Bullington) {:.1f} dB; least clearance {:.2f} F1\n",
                        l.free_space_db, l.ld_db, report.fresnel ? report.fresnel->fraction : 0);
  }
  if (report.budget)
    for (const std::string& line : profile::budget_lines(*report.budget)) text += line + "\n";
  if (report.reflection)
    text += fmt::format("reflection point at {:.1f} m; reflected path {}\n", report.reflection->distance_m,
                        screen_text(report, kMetres));
  if (report.visible) {
    const profile::VisibleHeight& seen = *report.visible;
    text += fmt::format("{:.1f} m of the object at the second end are seen ({:.0f} %)", seen.tip.visible_m,
                        100 * seen.tip.fraction);
    if (seen.hub)
      text += fmt::format(", {:.1f} m up to its hub ({:.0f} %)", seen.hub->visible_m, 100 * seen.hub->fraction);
    text += "\n";
  }
  return text + report.query.earth.convention() + "\n";
}

}  // namespace itin::cli
