#include "site/site_profiles.hpp"

#include <filesystem>
#include <set>
#include <string>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/los.hpp>

#include "output/output_path.hpp"

namespace itin::cli {

namespace {

using viewshed::SitePosition;

profile::LosReport report_of(const Store& store, const SiteOptions& options, const SitePosition& from,
                             const SitePosition& to) {
  const profile::LinkQuery rules = link_rules(options).query;
  profile::LosReport report = analyse(store, {from.position, to.position, rules.detail, rules.themes},
                                      los_query(link_between(from, to), rules));
  report.title = fmt::format("{} to {}", from.name, to.name);
  report.facts = {{"Store", std::filesystem::path(store.path()).filename().string()}};
  const auto about = [](const SitePosition& place) -> std::vector<std::string> {
    return {fmt::format("{}: {:.2f}, {:.2f}; {:g} m on {:.2f} m", place.name, place.position.x, place.position.y,
                        place.height, place.ground)};
  };
  report.from_lines = about(from), report.to_lines = about(to);
  return report;
}

}  // namespace

std::vector<SiteProfile> write_site_profiles(const Store& store, const SiteResult& r, const std::string& directory,
                                             bool overwrite, Progress& progress) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(directory) / "links";
  std::vector<SiteProfile> profiles;
  std::set<std::string> taken;
  for (const SiteLink& link : r.links) {
    progress.throw_if_cancelled();
    if (link.found().verdict == profile::SightVerdict::kHidden || link.line.distance_m == 0) continue;
    const SitePosition &from = link.from, &to = link.to;
    std::error_code failed;
    fs::create_directory(folder, failed);
    if (failed) throw FileError(folder.string(), "cannot be made (" + failed.message() + "); name another place");
    std::string name = file_name(from.name + "--" + to.name);
    if (!taken.insert(name).second) name += fmt::format("-{}", &link - r.links.data() + 1);
    taken.insert(name);
    const std::string path = (folder / (name + ".svg")).string();
    profile::write_report(report_of(store, r.options, from, to), {}, path, overwrite);
    profiles.push_back({path, fmt::format("{} to {}, {:.1f} km", from.name, to.name, link.line.distance_m / 1000)});
    progress.report("profiles of links",
                    static_cast<double>(&link - r.links.data() + 1) / static_cast<double>(r.links.size()));
  }
  return profiles;
}

}  // namespace itin::cli
