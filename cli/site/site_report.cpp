#include "site/site_report.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include <itin/base64.hpp>
#include <itin/document.hpp>
#include <itin/markup.hpp>
#include <itin/output_file.hpp>
#include <viewshed/site_wording.hpp>

#include "output/store_document.hpp"
#include "output/web_map.hpp"
#include "site/coverage_curve.hpp"
#include "site/site_report_tables.hpp"
#include "site/site_wording.hpp"

namespace itin::cli {

namespace {

/// A style that is readable at the width of a phone: parts wider than the page scroll by themselves.
constexpr const char* kStyle =
    "body{font:15px/1.45 system-ui,sans-serif;color:#222;max-width:64rem;margin:2rem auto;padding:0 1rem;"
    "overflow-wrap:anywhere}h1{font-size:1.6rem;margin:0 0 .3rem}h2{font-size:1.1rem;margin:1.6rem 0 .3rem}"
    ".scroll{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums;overflow-wrap:normal}"
    "td,th{padding:.18rem .9rem .18rem 0;text-align:left;vertical-align:top;border-bottom:1px solid #ddd}"
    "td.n,th.n{text-align:right}td.n,.wide "
    "td{white-space:nowrap}.curve{display:block;width:100%;font-size:12px;fill:#333}"
    ".profile{display:block;width:100%;min-width:42rem;height:auto}.note{color:#666;font-size:.9em}"
    ".headline{font-size:1.15rem;font-weight:600}pre{background:#f6f6f6;padding:.6rem;overflow-x:auto;font-size:.85em}"
    "@media print{body{margin:0;max-width:none}h2{break-after:avoid}figure{break-inside:avoid}.profile{min-width:0}}";

std::string drawing(const SiteProfile& profile) {
  return fmt::format(
      "<figure><figcaption>{0}</figcaption><div class=\"scroll\"><img class=\"profile\" alt=\"profile of {0}\" "
      "src=\"data:image/svg+xml;base64,{1}\"></div></figure>\n",
      escaped_markup(profile.what), base64(profile.svg));
}

std::string drawings(const viewshed::SitePlan& r, const std::vector<SiteProfile>& profiles) {
  const auto shown = static_cast<std::size_t>(
      std::count_if(profiles.begin(), profiles.end(), [](const SiteProfile& p) { return !p.svg.empty(); }));
  if (shown == 0) return {};
  std::string html = fmt::format("<h2>Profiles of the links {}</h2>\n",
                                 r.request.hub ? "on routes to the hub" : "that are not hidden");
  html += "<p class=\"note\">A is the site named first, B the second.";
  if (shown < profiles.size())
    html += fmt::format(" These are {} of {} links that are not hidden{}.", shown, profiles.size(),
                        r.request.hub ? "" : ", the shortest ones");
  html += "</p>\n";
  for (const SiteProfile& profile : profiles)
    if (!profile.svg.empty()) html += drawing(profile);
  return html;
}

std::string left_out(const viewshed::SitePlan& r) {
  if (r.inputs.left_out.empty()) return {};
  std::string html = fmt::format("<h2>Rows left out: {}</h2>\n<ul class=\"note\">\n", r.inputs.left_out.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(r.inputs.left_out.size(), 50); ++i)
    html += "<li>" + escaped_markup(r.inputs.left_out[i]) + "</li>\n";
  return html + "</ul>\n";
}

/// Tells how few candidates had to be surveyed closely, and why that was enough.
std::string times_surveyed(const viewshed::SitePlan& r) {
  const std::size_t candidates = r.inputs.candidates.size(), options = r.inputs.options.size();
  const std::string all =
      counted(candidates, "candidate") +
      (options == candidates ? "" : fmt::format(", {} with their masts", counted(options, "option")));
  if (r.all_exact()) return fmt::format("Surveyed exactly: {}.", all);
  return fmt::format(
      "Estimated: {}. Surveyed more closely: {} of them. For the others that was not needed: {}, so exact "
      "coverage of all would have led to the same choice.",
      all, grouped(r.refined()), viewshed::wording_of(r.request).sufficient);
}

std::string exchanges(const viewshed::SitePlan& r) {
  if (r.choice.swaps == 0) return {};
  return fmt::format(" The first selection was improved by {} of one {} for another.",
                     counted(r.choice.swaps, "exchange"), viewshed::wording_of(r.request).one);
}

/// Returns the bound on all choices, with its distance where this choice does not meet it.
std::string best_possible(const viewshed::SitePlan& r) {
  const viewshed::Weight missed = r.choice.upper_bound - r.choice.value;
  const std::string text = fmt::format("No choice within the same limits {}serves more", certainly(r));
  if (missed <= 0) return text + ".";
  return text + fmt::format(" than {}, which is {} more.",
                            amount(r.in_metric(r.choice.upper_bound + r.choice.existing)), amount(r.in_metric(missed)));
}

/// Tells how much of the summary ground without data leaves open.
std::string left_open(const viewshed::SitePlan& r) {
  return r.undecided == 0 ? "" : fmt::format("<p>Undecided: {}.</p>\n", escaped_markup(undecided_in_words(r)));
}

std::string summary(const viewshed::SitePlan& r) {
  if (r.request.turbines) {
    std::string least = least_in_words(r);
    least.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(least.front())));
    return fmt::format("<p class=\"headline\">{}.</p>\n{}<p>{}{}</p>\n", escaped_markup(least), left_open(r),
                       times_surveyed(r), exchanges(r));
  }
  const std::string existing = r.choice.existing > 0
                                   ? fmt::format(", {} of it by {}", amount(r.in_metric(r.choice.existing)),
                                                 counted(r.inputs.existing(), "existing site"))
                                   : "";
  std::string cost = cost_in_words(r);
  if (!cost.empty()) cost.front() = 'T', cost = "<p>" + cost + ".</p>\n";
  return fmt::format("<p class=\"headline\">{}: {}{}. {}</p>\n{}{}<p>{}{}</p>\n",
                     r.leaves_open ? "Certainly served" : "Served", amount_served_in_words(r), existing,
                     best_possible(r), cost, left_open(r), times_surveyed(r), exchanges(r));
}

/// Returns the routes to the hub, where there is one, and the rule by which they are chosen.
std::string backhaul(const viewshed::SitePlan& r) {
  if (!r.request.hub) return {};
  return fmt::format(
      "<h2>Routes to the hub</h2>\n<p class=\"note\">Each route has the fewest hops, and among those the least length. "
      "A hop is a link that is {}.</p>\n{}",
      r.request.frequency_ghz
          ? fmt::format("visible and leaves at least {:g} of the first Fresnel zone clear", r.request.fresnel)
          : "visible",
      routes_html(r));
}

}  // namespace

void write_site_report(const std::string& path, const viewshed::SitePlan& r, const SiteReportParts& parts,
                       bool overwrite) {
  const viewshed::SiteWording wording = viewshed::wording_of(r.request);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\"><title>Siting report</title><style>{}{}</style></head>"
      "<body>\n<h1>{} chosen from {}</h1>\n",
      kStyle, kWebMapStyle, counted(r.choice.chosen.size(), wording.one),
      counted(r.inputs.candidates.size(), "candidate"));
  html += summary(r);
  html += parts.figures.at(0);
  if (r.levels) html += "<h2>Levels</h2>\n" + parts.figures.at(2);
  html += backhaul(r);
  html += "<h2>" + wording.coverage_curve + "</h2>\n" + coverage_curve(r);
  html += "<h2>" + wording.order + "</h2>\n" + (r.request.turbines ? turbines_html(r) : sites_html(r));
  if (!r.points.empty()) html += "<h2>Points of the demand</h2>\n" + points_html(r);
  if (!r.all_exact()) html += "<h2>How closely candidates were surveyed</h2>\n" + stages_html(r);
  if (const std::string closest = closest_html(r); !closest.empty())
    html += "<h2>Candidates that came closest to being chosen</h2>\n" + closest;
  if (!r.network.links.empty()) html += "<h2>Lines of sight between sites</h2>\n" + links_html(r);
  html += drawings(r, parts.profiles);
  html += "<h2>" + wording.count_heading + "</h2>\n" + parts.figures.at(1);
  html += left_out(r);
  html += "<h2>Sources of the ground</h2>\n<ul class=\"note\">\n";
  for (const std::string& source : parts.sources) html += "<li>" + escaped_markup(source) + "</li>\n";
  html += "</ul>\n";
  html += fmt::format("<h2>Parameters and inputs</h2>\n<p class=\"note\">{}. {}</p>\n<pre>{}</pre>\n",
                      escaped_markup(r.meaning()), escaped_markup(r.request.earth.convention()),
                      escaped_markup(json_text(parts.parameters, 2)));
  html += fmt::format("<p class=\"note\">itin {}</p>\n</body></html>\n", ITIN_VERSION);
  write_file(path, html, overwrite);
}

}  // namespace itin::cli
