#include "site/site_outputs.hpp"

#include <filesystem>
#include <fstream>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include <viewshed/site_maps.hpp>

#include "program/field_names.hpp"

namespace itin::cli {

std::vector<viewshed::PlanFile> site_outputs(const SiteOptions& options, OutputPolicy& policy) {
  std::vector<viewshed::PlanFile> files = site_plan_files(options.directory, options.request);
  const auto add = [&](auto place, const std::string& name, const std::string& what) {
    return files.insert(place, {options.path(name), what}) + 1;
  };
  auto place = files.end() - (options.request.hub ? 1 : 0);  // routes come behind these
  place = add(place, "report.html", "everything on one page");
  place = add(place, "site.json", "the result as a document");
  add(place, "parameters.json", "for --params: runs this again");
  for (const profile::PaperSize paper : options.sheets.papers())
    for (const std::string& map : viewshed::site_map_names(options.request))
      for (const std::string& name : viewshed::sheet_names(map, paper))
        add(files.end(), name, fmt::format("{}.tif as a map on paper", map));
  for (viewshed::PlanFile& file : files) {
    file.what = in_options(std::move(file.what));
    policy.claim(file.path);
  }
  return files;
}

void remove_former_outputs(const SiteOptions& options, const Document& outputs) {
  namespace fs = std::filesystem;
  std::ifstream file(options.path("site.json"));
  const Document former = Document::parse(file, nullptr, false);
  if (!former.is_object() || !former.contains("outputs") || !former["outputs"].is_array()) return;
  // The folder may have had another name, so that files are compared by their places within the folder.
  const auto place_of = [&](const fs::path& path) {
    const bool profile = path.parent_path().filename() == kLinkFolder;
    return profile ? fs::path(kLinkFolder) / path.filename() : path.filename();
  };
  std::set<fs::path> now;
  for (const Document& output : outputs) now.insert(place_of(output["path"].get<std::string>()));
  for (const Document& output : former["outputs"]) {
    if (!output.is_object() || !output.contains("path") || !output["path"].is_string()) continue;
    const fs::path place = place_of(output["path"].get<std::string>());
    std::error_code ignored;
    if (!now.contains(place)) fs::remove(options.path(place.string()), ignored);
  }
}

}  // namespace itin::cli
