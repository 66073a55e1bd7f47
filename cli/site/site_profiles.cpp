#include "site/site_profiles.hpp"

#include <filesystem>
#include <set>
#include <string>

#include <fmt/format.h>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <profile/los.hpp>

#include "options/radio_options.hpp"
#include "output/output_path.hpp"

namespace itin::cli {

namespace {

using viewshed::SiteStand;

profile::LosReport report_of(const Store& store, const SiteOptions& options, const SiteStand& from,
                             const SiteStand& to) {
  profile::LosQuery query;
  query.from_height_m = from.height, query.to_height_m = to.height;
  query.from_on_surface = query.to_on_surface = options.on_surface;
  query.earth = options.earth.earth();
  query.gaps_block = options.nodata == viewshed::NoData::kBlock;
  if (options.frequency_ghz && query.earth.drop_coefficient() > 0) {
    query.radio.emplace();
    query.radio->frequency_ghz = *options.frequency_ghz;
    query.radio->effective_earth_km = effective_earth_km(query.earth);
  }
  const ThemeChoice& themes = options.themes.choice();
  const auto profile_with = [&](const ThemeChoice& choice) {
    return profile::from_section(cross_section(store, from.position, to.position, Detail::tolerance(0), choice));
  };
  profile::Profile ground;
  if (themes.includes_standing(store.metadata().themes)) ground = profile_with(ThemeChoice::none());
  profile::LosReport report = profile::analyse(profile_with(themes), query, std::move(ground));
  report.title = fmt::format("{} to {}", from.name, to.name);
  report.facts = {{"Store", std::filesystem::path(store.path()).filename().string()}};
  const auto about = [](const SiteStand& stand) -> std::vector<std::string> {
    return {fmt::format("{}: {:.2f}, {:.2f}; {:g} m on {:.2f} m", stand.name, stand.position.x, stand.position.y,
                        stand.height, stand.ground)};
  };
  report.from_lines = about(from), report.to_lines = about(to);
  report.crs_wkt = store.metadata().crs_wkt;
  report.themes = profile::theme_names(store.metadata());
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
    if (!link.visible || link.distance_m == 0) continue;
    const SiteStand &from = link.from, &to = link.to;
    std::error_code failed;
    fs::create_directory(folder, failed);
    if (failed) throw FileError(folder.string(), "cannot be made (" + failed.message() + "); name another place");
    std::string name = file_name(from.name + "--" + to.name);
    if (!taken.insert(name).second) name += fmt::format("-{}", &link - r.links.data() + 1);
    taken.insert(name);
    const std::string path = (folder / (name + ".svg")).string();
    profile::write_report(report_of(store, r.options, from, to), {}, path, overwrite);
    profiles.push_back({path, fmt::format("{} to {}, {:.1f} km", from.name, to.name, link.distance_m / 1000)});
    progress.report("profiles of links",
                    static_cast<double>(&link - r.links.data() + 1) / static_cast<double>(r.links.size()));
  }
  return profiles;
}

}  // namespace itin::cli
