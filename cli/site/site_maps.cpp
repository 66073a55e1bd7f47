#include "site/site_maps.hpp"

#include <utility>

#include <fmt/format.h>

#include <itin/output_file.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/site_maps.hpp>
#include <viewshed/site_wording.hpp>

#include "output/store_document.hpp"
#include "output/web_map.hpp"
#include "site/site_wording.hpp"

namespace itin::cli {

namespace {

/// Adds to the maps' title blocks how good the choice is, before the fact of the Earth, and the sources of the ground.
std::vector<viewshed::SiteMap> titled_maps(const Store& store, const viewshed::SitePlan& r,
                                           const std::vector<std::string>& sources, Progress& progress) {
  std::vector<std::pair<std::string, std::string>> facts{
      {"Choice", fmt::format("{}, {}", counted(r.choice.chosen.size(), viewshed::wording_of(r.request).one),
                             r.request.turbines ? least_in_words(r) : served_in_words(r))}};
  if (r.undecided > 0) facts.emplace_back("Undecided", undecided_in_words(r));
  std::vector<viewshed::SiteMap> maps = viewshed::site_maps(store, r, progress);
  for (viewshed::SiteMap& map : maps) {
    profile::TitleBlock& title = map.sheet.title;
    title.facts.insert(title.facts.end() - 1, facts.begin(), facts.end());
    title.sources = sources;
  }
  return maps;
}

}  // namespace

std::vector<std::string> site_figures(const Store& store, const viewshed::SitePlan& r, Progress& progress) {
  const std::vector<viewshed::SiteMap> maps = titled_maps(store, r, {}, progress);
  WebMaps web(store, maps.front().sheet.area, progress);
  std::vector<std::string> figures;
  for (const viewshed::SiteMap& map : maps) figures.push_back(web.figure(map.sheet, map.about));
  return figures;
}

void write_site_sheets(const Store& store, const SiteOptions& options, const viewshed::SitePlan& r,
                       const std::vector<std::string>& sources, bool overwrite, Progress& progress) {
  if (!options.sheets.given()) return;
  const std::vector<viewshed::SiteMap> maps = titled_maps(store, r, sources, progress);
  for (const profile::PaperSize paper : options.sheets.papers()) {
    const viewshed::MapBase base = base_of(store, maps.front().sheet, paper, options.sheets.choice(), progress);
    for (const viewshed::SiteMap& map : maps) {
      const profile::MapSheet sheet = map_sheet(store, map.sheet, base, paper, options.sheets.choice());
      for (const std::string& name : viewshed::sheet_names(map.name, paper))
        write_file(options.path(name), profile::draw_map_sheet(sheet, name), overwrite);
    }
  }
}

}  // namespace itin::cli
