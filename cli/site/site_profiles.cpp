#include "site/site_profiles.hpp"

#include <algorithm>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/los.hpp>
#include <profile/sight_svg.hpp>
#include <viewshed/site_links.hpp>

#include "output/file_names.hpp"

namespace itin::cli {

namespace {

using viewshed::SitePosition;

constexpr double kProfileWidth = 842, kProfileHeight = 300;  ///< a sight line's drawing in the report, points

profile::LosReport report_of(const Store& store, const viewshed::SitePlanRequest& request, const SitePosition& from,
                             const SitePosition& to) {
  const profile::LinkQuery rules = viewshed::link_rules(request).query;
  profile::LosReport report = analyse(store, {from.position, to.position, rules.detail, rules.themes},
                                      los_query(viewshed::link_between(from, to), rules));
  report.title = fmt::format("{} to {}", from.name, to.name);
  report.facts = {{"Store", std::filesystem::path(store.path()).filename().string()}};
  const auto about = [](const SitePosition& place) -> std::vector<std::string> {
    return {fmt::format("{}: {:.2f}, {:.2f}; {:g} m on {:.2f} m", place.name, place.position.x, place.position.y,
                        place.height, place.ground)};
  };
  report.from_lines = about(from), report.to_lines = about(to);
  return report;
}

bool is_drawn(const viewshed::SiteLink& link) {
  return link.found().verdict != profile::SightVerdict::kHidden && link.line.distance_m > 0;
}

/// Tells for each link whether the report shows its profile.
std::vector<char> shown_in_report(const viewshed::SitePlan& r) {
  std::vector<char> shown(r.network.links.size());
  if (r.request.hub) {
    const std::vector<std::size_t> routes = routes_over_links(r.network, r.routes);
    for (std::size_t i = 0; i < shown.size(); ++i) shown[i] = routes[i] > 0;
    return shown;
  }
  std::vector<std::pair<double, std::size_t>> shortest;
  for (std::size_t i = 0; i < shown.size(); ++i)
    if (is_drawn(r.network.links[i])) shortest.emplace_back(r.network.links[i].line.distance_m, i);
  std::sort(shortest.begin(), shortest.end());
  if (shortest.size() > kMostProfiles) shortest.resize(kMostProfiles);
  for (const auto& [distance, i] : shortest) shown[i] = true;
  return shown;
}

}  // namespace

std::vector<SiteProfile> write_site_profiles(const Store& store, const viewshed::SitePlan& r, const std::string& folder,
                                             bool overwrite, Progress& progress) {
  namespace fs = std::filesystem;
  std::vector<SiteProfile> profiles;
  FileNames names;
  const std::vector<char> in_report = shown_in_report(r);
  for (std::size_t i = 0; i < r.network.links.size(); ++i) {
    const viewshed::SiteLink& link = r.network.links[i];
    progress.throw_if_cancelled();
    if (!is_drawn(link)) continue;
    const SitePosition &from = r.network.from(link), &to = r.network.to(link);
    std::error_code failed;
    fs::create_directory(folder, failed);
    if (failed) throw FileError(folder, "cannot be made (" + failed.message() + "); name another place");
    const std::string name = names.add(from.name + "--" + to.name, i + 1);
    const std::string path = (fs::path(folder) / (name + ".svg")).string();
    const profile::LosReport report = report_of(store, r.request, from, to);
    profile::write_report(report, {}, path, overwrite);
    profiles.push_back({path, fmt::format("{} to {}, {:.2f} km", from.name, to.name, link.line.distance_m / 1000),
                        in_report[i] ? profile::sight_svg(report, kProfileWidth, kProfileHeight) : ""});
    progress.report("profiles of links", static_cast<double>(i + 1) / static_cast<double>(r.network.links.size()));
  }
  return profiles;
}

}  // namespace itin::cli
