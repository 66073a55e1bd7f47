#include <itin/error.hpp>
#include <itin/site_list.hpp>
#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

SitePlaces read_dwellings(const std::string& path, const std::string& crs, const std::string& to_crs) {
  SiteQuery query;
  query.path = path, query.crs = crs;
  take_names(query, LayerFields(query));
  SitePlaces dwellings;
  dwellings.source = path;
  for (const Site& site : read_sites(query, to_crs, dwellings.warnings)) {
    const std::string name = site.name.empty() ? std::to_string(site.row + 1) : site.name;
    dwellings.places.push_back({.name = name, .position = site.position, .origin = site.place});
  }
  if (dwellings.places.empty()) throw InputError(none_in(query, "dwelling"));
  return dwellings;
}

}  // namespace itin::viewshed
