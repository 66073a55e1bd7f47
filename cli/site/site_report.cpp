#include "site/site_report.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include <itin/base64.hpp>
#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/markup.hpp>
#include <itin/output_file.hpp>

#include "output/store_document.hpp"
#include "site/site_wording.hpp"

namespace itin::cli {

namespace {

constexpr const char* kStyle =
    "body{font:15px/1.45 system-ui,sans-serif;color:#222;max-width:64rem;margin:2rem auto;padding:0 1rem}"
    "h1{font-size:1.6rem;margin:0 0 .3rem}h2{font-size:1.1rem;margin:1.6rem 0 .3rem}"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums}td,th{padding:.18rem .9rem .18rem 0;"
    "text-align:left;vertical-align:top;border-bottom:1px solid #ddd}td.n,th.n{text-align:right}"
    "img,svg{width:100%;height:auto}.note{color:#666;font-size:.9em}.figure{font-size:1.15rem;font-weight:600}"
    "pre{background:#f6f6f6;padding:.6rem;overflow-x:auto;font-size:.85em}"
    "@media print{body{margin:0;max-width:none}h2{break-after:avoid}}";

std::string amount(double v) {
  return v == std::floor(v) && v < 1e15 ? grouped(static_cast<std::uint64_t>(v)) : fmt::format("{:.6g}", v);
}

/// A table of text and, from column `numbers` on, of figures.
class HtmlTable {
 public:
  HtmlTable(const std::vector<std::string>& header, std::size_t numbers) : numbers_(numbers) { add(header, "th"); }
  void add(const std::vector<std::string>& cells, const char* tag = "td") {
    html_ += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
      html_ += fmt::format("<{0}{1}>{2}</{0}>", tag, i >= numbers_ ? " class=\"n\"" : "", escaped_markup(cells[i]));
    html_ += "</tr>\n";
  }
  std::string finish() const { return "<table>\n" + html_ + "</table>\n"; }

 private:
  std::size_t numbers_;
  std::string html_;
};

/// Share served against the number of sites, below the bound on every choice.
std::string curve(const SiteResult& r) {
  constexpr double kWidth = 900, kHeight = 300, kLeft = 60, kRight = 20, kTop = 20, kBottom = 40;
  const std::size_t n = r.choice.chosen.size();
  // Heights seen have no whole but what the choice shows.
  const bool heights = r.options.placement.sums_heights();
  const double total = std::max(1.0, static_cast<double>(heights ? r.choice.value : r.inputs.total));
  const double most = std::max<double>(static_cast<double>(r.choice.upper_bound), 1) / total * 1.08;
  const auto x = [&](double i) {
    return kLeft + (kWidth - kLeft - kRight) * i / static_cast<double>(std::max<std::size_t>(n, 1));
  };
  const auto y = [&](double share) { return kHeight - kBottom - (kHeight - kTop - kBottom) * share / most; };
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"coverage curve\" font-size=\"12\" fill=\"#333\">\n", kWidth,
      kHeight);
  const double step = most > 0.5 ? 0.1 : most > 0.2 ? 0.05 : most > 0.05 ? 0.01 : most / 4;
  for (double share = 0; share <= most; share += step) {
    svg += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>"
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:.3g} %</text>\n",
        kLeft, y(share), kWidth - kRight, y(share), kLeft - 6, y(share) + 4, 100 * share);
  }
  std::string line = fmt::format("{:.1f},{:.1f}", x(0), y(0));
  for (std::size_t i = 0; i < n; ++i) {
    const double share = static_cast<double>(r.choice.chosen[i].cumulative) / total;
    const double before = i == 0 ? 0 : static_cast<double>(r.choice.chosen[i - 1].cumulative) / total;
    const double at = static_cast<double>(i + 1);
    line += fmt::format(" {:.1f},{:.1f}", x(at), y(share));
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#0072b2\" opacity=\".25\"/>"
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
        x(at) - 6, y(share), 12.0, y(before) - y(share), x(at), kHeight - kBottom + 16,
        escaped_markup(r.place_of(r.choice.chosen[i]).name));
  }
  svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"2.5\"/>\n", line);
  const bool turbines = r.options.placement.given();
  const double bound = static_cast<double>(turbines ? r.choice.lower_bound : r.choice.upper_bound) / total;
  svg += fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#d55e00\" stroke-dasharray=\"6 4\"/>"
      "<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"#d55e00\">{} {:.1f} %</text>\n",
      kLeft, y(bound), kWidth - kRight, y(bound), kLeft + 8, y(bound) - 5, wording_of(r.options).bound, 100 * bound);
  return svg + "</svg>\n";
}

std::string sites_html(const SiteResult& r) {
  HtmlTable table({"", "Site", "Easting", "Northing", "Mast m", "Ground m", "Stands on m", "Cost", "Gain", "Together",
                   "First look: at least", "at most", "Alone, in the end"},
                  2);
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i) {
    const viewshed::ChosenSite& site = r.choice.chosen[i];
    const viewshed::SitePosition& place = r.place_of(site);
    const CoverageSummary first = r.summary(r.coverage.first_bounds(site.option)),
                          now = r.summary(r.coverage.bounds(site.option));
    table.add({fmt::format("{}", i + 1), place.name, fmt::format("{:.0f}", place.position.x),
               fmt::format("{:.0f}", place.position.y), fmt::format("{:g}", place.height),
               fmt::format("{:.1f}", r.ground_m[i]), fmt::format("{:.1f}", place.ground),
               fmt::format("{:g}", r.inputs.options[site.option].cost), amount(r.in_metric(site.gain)),
               amount(r.in_metric(site.cumulative)), amount(first.certain), amount(first.possible),
               amount(now.certain)});
  }
  return table.finish();
}

std::string turbines_html(const SiteResult& r) {
  const bool heights = r.options.placement.sums_heights();
  HtmlTable table(
      {"", "Turbine", "Easting", "Northing", "Ground m", heights ? "Shows m" : "Adds", "Together", "Seen from, alone"},
      2);
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i) {
    const viewshed::ChosenSite& site = r.choice.chosen[i];
    const viewshed::SitePosition& place = r.place_of(site);
    table.add({fmt::format("{}", i + 1), place.name, fmt::format("{:.0f}", place.position.x),
               fmt::format("{:.0f}", place.position.y), fmt::format("{:.1f}", r.ground_m[i]),
               amount(r.in_metric(site.gain)), amount(r.in_metric(site.cumulative)),
               amount(r.summary(r.coverage.bounds(site.option)).certain)});
  }
  return table.finish();
}

std::string stages_html(const SiteResult& r) {
  HtmlTable table({"Looked at", "Options for which this was enough"}, 1);
  for (int stage = 0; stage <= r.coverage.last_stage(); ++stage) {
    std::size_t stayed = 0;
    for (std::size_t i = 0; i < r.inputs.options.size(); ++i) stayed += r.coverage.stage(i) == stage;
    table.add({r.coverage.stage_name(stage), grouped(stayed)});
  }
  return table.finish();
}

/// The options that came nearest to being chosen.
std::string closest_html(const SiteResult& r) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < r.inputs.options.size(); ++i) {
    const auto& margin = r.choice.closest[i];
    if (margin && !r.is_chosen(i)) order.emplace_back(-closeness(*margin, r.options.objective()), i);
  }
  std::sort(order.begin(), order.end());
  HtmlTable table({"Candidate", "Looked at", "Outcome"}, 3);
  for (std::size_t i = 0; i < std::min<std::size_t>(order.size(), 10); ++i) {
    const std::size_t option = order[i].second;
    table.add({r.inputs.positions[option].name, r.coverage.stage_name(r.coverage.stage(option)), r.reason(option)});
  }
  return table.finish();
}

std::string links_html(const SiteResult& r) {
  HtmlTable table({"From", "To", "Verdict", "km", "Clearance m", "of F1", "No data m"}, 3);
  for (const SiteLink& link : r.links) {
    table.add({link.from.name, link.to.name, outcome_of(r.options, link),
               fmt::format("{:.3f}", link.line.distance_m / 1000),
               link.found().clearance_m ? fmt::format("{:.2f}", *link.found().clearance_m) : "",
               link.found().fresnel ? fmt::format("{:.2f}", link.found().fresnel->fraction) : "",
               link.line.gap_m > 0 ? fmt::format("{:.0f}", link.line.gap_m) : ""});
  }
  return table.finish();
}

std::string image(const std::string& path, const std::string& type, const std::string& what) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.empty()) throw FileError(path, "cannot be read back for the report");
  return fmt::format("<img alt=\"{}\" src=\"data:{};base64,{}\">\n", escaped_markup(what), type, base64(bytes));
}

std::string map(const std::string& directory, const char* name, const char* what) {
  return image((std::filesystem::path(directory) / name).string(), "image/png", what);
}

std::string drawings(const std::vector<SiteProfile>& profiles) {
  if (profiles.empty()) return {};
  std::string html = "<h2>Profiles of the links that are not hidden</h2>\n";
  for (const SiteProfile& profile : profiles)
    html += "<p class=\"note\">" + escaped_markup(profile.what) + "</p>\n" +
            image(profile.path, "image/svg+xml", "profile of " + profile.what);
  return html;
}

std::string left_out(const SiteResult& r) {
  if (r.inputs.rejected.empty()) return {};
  std::string html = fmt::format("<h2>Rows left out: {}</h2>\n<ul class=\"note\">\n", r.inputs.rejected.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(r.inputs.rejected.size(), 50); ++i)
    html += "<li>" + escaped_markup(r.inputs.rejected[i]) + "</li>\n";
  return html + "</ul>\n";
}

/// How few candidates had to be looked at closely, and why that was enough.
std::string times_examined(const SiteResult& r) {
  const std::string options =
      counted(r.inputs.candidates.size(), "candidate") + ", " + counted(r.inputs.options.size(), "option");
  if (r.options.placement.sums_heights()) return options + "; every one was looked at exactly.";
  if (r.coverage.last_stage() == 0) return options + "; the first look at each was exact.";
  return fmt::format(
      "{}; {} of them were looked at again after the first look. The others could be left: {}, so exact coverage of "
      "all "
      "would have led to the same choice.",
      options, r.refined(), wording_of(r.options).sufficient);
}

std::string exchanges(const SiteResult& r) {
  if (r.choice.swaps == 0) return {};
  const std::string count = counted(r.choice.swaps, "exchange");
  return r.options.placement.given() ? fmt::format(" {} after greedy made it less.", count)
                                     : fmt::format(" More was gained by {} after greedy.", count);
}

std::string summary(const SiteResult& r) {
  if (r.options.placement.given()) {
    std::string least = least_in_words(r);
    least.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(least.front())));
    return fmt::format("<p class=\"figure\">{}.</p>\n<p>{}{}</p>\n", escaped_markup(least), times_examined(r),
                       exchanges(r));
  }
  const std::string existing = r.choice.existing > 0
                                   ? fmt::format(", {} of it by {}", amount(r.in_metric(r.choice.existing)),
                                                 counted(r.inputs.existing(), "existing site"))
                                   : "";
  return fmt::format(
      "<p class=\"figure\">Served: {} of a demand of {} ({:.1f} %){}. No choice within the same limits serves more "
      "than {}: at most {:.1f} % of that were missed.</p>\n<p>{}{}</p>\n",
      amount(r.served()), amount(r.in_metric(r.inputs.total)), r.served_percent(), existing,
      amount(r.in_metric(r.choice.upper_bound + r.choice.existing)), viewshed::gap_percent(r.choice), times_examined(r),
      exchanges(r));
}

}  // namespace

void write_site_report(const SiteResult& r, const std::vector<SiteProfile>& profiles, const Document& parameters,
                       const Document& inputs, const std::vector<std::string>& sources, const std::string& directory,
                       bool overwrite) {
  const SiteWording wording = wording_of(r.options);
  const bool turbines = r.options.placement.given();
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}s</title><style>{}</style></head>"
      "<body>\n<h1>{} chosen from {}</h1>\n",
      wording.mark, kStyle, counted(r.choice.chosen.size(), wording.one),
      counted(r.inputs.candidates.size(), "candidate"));
  html += summary(r);
  html += map(directory, "coverage.png", turbines ? "map of what sees the turbines" : "map of what the choice serves");
  html += "<h2>" + wording.coverage_curve + "</h2>\n" + curve(r);
  html += "<h2>" + wording.order + "</h2>\n" + (turbines ? turbines_html(r) : sites_html(r));
  if (!r.options.placement.sums_heights())
    html += "<h2>How closely candidates had to be looked at</h2>\n" + stages_html(r);
  html += "<h2>Those that came nearest</h2>\n" + closest_html(r);
  if (!r.links.empty()) html += "<h2>Lines of sight between sites</h2>\n" + links_html(r);
  html += drawings(profiles);
  html += "<h2>" + wording.count_heading + "</h2>\n" +
          map(directory, "redundancy.png",
              turbines ? "map of how many turbines a place sees" : "map of how many sites serve a place");
  html += left_out(r);
  html += "<h2>Sources of the ground</h2>\n<ul class=\"note\">\n";
  for (const std::string& source : sources) html += "<li>" + escaped_markup(source) + "</li>\n";
  html += "</ul>\n";
  html +=
      fmt::format("<h2>Parameters and inputs</h2>\n<p class=\"note\">{}. {}</p>\n<pre>{}</pre>\n<pre>{}</pre>\n",
                  escaped_markup(r.options.meaning_of_served()), escaped_markup(r.options.earth.earth().convention()),
                  escaped_markup(json_text(parameters, 2)), escaped_markup(json_text(inputs, 2)));
  html += fmt::format("<p class=\"note\">itin {}</p>\n</body></html>\n", ITIN_VERSION);
  write_file((std::filesystem::path(directory) / "report.html").string(), html, overwrite);
}

}  // namespace itin::cli
