#include "site/site_request.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/raster_values.hpp>
#include <itin/site_list.hpp>
#include <itin/sites.hpp>
#include <itin/window_source.hpp>
#include <profile/antenna_columns.hpp>
#include <viewshed/sector_names.hpp>

#include "options/places/off_the_data.hpp"

namespace itin::cli {

namespace {

class RequestFiles {
 public:
  RequestFiles(const SiteOptions& options, const StoreMetadata& metadata)
      : options_(options), metadata_(metadata), crs_(metadata.crs_wkt), request_(options.request) {}

  viewshed::SitePlanRequest read() && {
    request_.earth = options_.earth.earth();
    if (options_.search_area.empty()) {
      read_candidates();
    } else {
      read_search_area();
    }
    if (!options_.existing.empty()) read_existing();
    if (!options_.forbidden.empty()) request_.forbidden = area(options_.forbidden);
    if (request_.turbines && request_.turbines->dwellings) read_dwellings(*request_.turbines->dwellings);
    read_demand();
    if (options_.hub)
      request_.hub = {.position = on_the_data("--hub", *options_.hub, options_.in_crs, metadata_),
                      .height = options_.hub->height};
    return std::move(request_);
  }

 private:
  Window area(const std::string& wkt_or_file) const {
    return window_from_polygon(wkt_or_file, crs_, options_.in_crs.crs);
  }

  void read_search_area() {
    const Window searched = area(options_.search_area);
    if (!searched.bounds().meets(metadata_.grid.box(metadata_.bounds)))
      require_on_the_data("--search-area: its first corner", searched.parts().front().outer.front(), options_.in_crs,
                          metadata_);
    request_.search_area = searched;
  }

  /// Returns a query about a file of the call.
  SiteQuery query_of(const std::string& path, const std::string& height_field = {}) const {
    SiteQuery query;
    query.path = path;
    query.height_field = height_field;
    query.crs = options_.in_crs.crs;
    return query;
  }

  /// Returns the places of a file. Calls add(site, place), which completes each.
  template <class Complete>
  viewshed::SitePlaces places_of(const SiteQuery& query, viewshed::SitePlaces places, const Complete& complete) const {
    places.source = query.path;
    for (const Site& site : read_sites(query, crs_, places.warnings, places.left_out)) {
      places.places.push_back({.position = site.position, .height = site.height, .origin = site.place});
      complete(site, places.places.back());
    }
    return places;
  }

  /// Adds the field that holds a number for each place to the query, or else warns of one that may.
  viewshed::SitePlaces with_number(SiteQuery& query, const std::string& field, const char* likely,
                                   const char* option) const {
    viewshed::SitePlaces places;
    if (field.empty()) {
      warn_of_unused(query, LayerFields(query), likely, option, places.warnings);
    } else {
      query.numbers.push_back({field});
    }
    return places;
  }

  /// Returns the name of a row; its number from 0 where no field has names.
  static std::string name_of(const Site& site, const SiteQuery& query) {
    return query.name_field.empty() ? std::to_string(site.row) : site.name;
  }

  static double number_of(const Site& site, double without_field) {
    return site.numbers.empty() ? without_field : site.numbers.front().value_or(std::nan(""));
  }

  void require_any(const viewshed::SitePlaces& places, const SiteQuery& query, const char* what) const {
    if (places.places.empty() && places.left_out.empty()) throw InputError(none_in(query, what));
  }

  /// The columns of antennas, where there are link budgets, which alone ask for them.
  std::optional<profile::AntennaColumns> antennas_of(SiteQuery& query) const {
    if (!request_.by_level()) return std::nullopt;
    return std::optional<profile::AntennaColumns>(std::in_place, query);
  }

  static void take_antenna(std::optional<profile::AntennaColumns>& antennas, const Site& site,
                           viewshed::SitePlace& place) {
    if (!antennas) return;
    viewshed::SiteSector sector{place.name, antennas->of(site)};
    if (!sector.antenna.empty()) place.sectors.push_back(std::move(sector));
  }

  /// Makes one place of the rows that are the sectors of a mast: those at one position, of one height, with antennas.
  static void join_sectors(viewshed::SitePlaces& places) {
    std::vector<viewshed::SitePlace> joined;
    std::map<std::tuple<double, double, std::optional<double>>, std::size_t> masts;
    for (viewshed::SitePlace& place : places.places) {
      if (!place.sectors.empty()) {
        const auto [mast, first] = masts.try_emplace({place.position.x, place.position.y, place.height}, joined.size());
        if (!first) {
          joined[mast->second].sectors.push_back(std::move(place.sectors.front()));
          continue;
        }
      }
      joined.push_back(std::move(place));
    }
    for (viewshed::SitePlace& mast : joined)
      if (mast.sectors.size() > 1) mast.name = name_of_mast(mast);
    places.places = std::move(joined);
  }

  /// Returns what the names of a mast's sectors begin with, or else the name of the first.
  static std::string name_of_mast(const viewshed::SitePlace& mast) {
    std::vector<std::string> names;
    for (const viewshed::SiteSector& sector : mast.sectors) names.push_back(sector.name);
    const std::string beginning = viewshed::shared_beginning(names);
    return beginning.empty() ? names.front() : beginning;
  }

  void read_candidates() {
    SiteQuery query = options_.candidates;
    query.crs = options_.in_crs.crs;
    viewshed::SitePlaces begun = with_number(query, options_.cost_field, "cost", "--cost-field");
    auto antennas = antennas_of(query);
    request_.candidates = places_of(query, std::move(begun), [&](const Site& site, viewshed::SitePlace& candidate) {
      candidate.name = name_of(site, query);
      candidate.cost = options_.cost_field.empty() ? 0 : number_of(site, 0);
      take_antenna(antennas, site, candidate);
    });
    join_sectors(request_.candidates);
    require_any(request_.candidates, query, "candidate");
    std::vector<Point2> positions;
    for (const viewshed::SitePlace& candidate : request_.candidates.places) positions.push_back(candidate.position);
    require_any_on_the_data(query.path + ": the first candidate", positions, options_.in_crs, metadata_);
  }

  void read_existing() {
    SiteQuery query = query_of(options_.existing, options_.existing_height_field);
    take_names(query, LayerFields(query));
    auto antennas = antennas_of(query);
    request_.existing = places_of(query, {}, [&](const Site& site, viewshed::SitePlace& place) {
      place.name = site.name;
      take_antenna(antennas, site, place);
    });
    join_sectors(request_.existing);
    require_any(request_.existing, query, "site");
  }

  /// Reads the dwellings, which are points or polygons. No dwelling may be left out.
  void read_dwellings(viewshed::SiteDwellings& dwellings) const {
    const SiteQuery query = query_of(options_.placement.dwellings);
    dwellings.source = query.path;
    std::vector<std::string> no_points;
    for (const Site& site : read_sites(query, crs_, dwellings.warnings, no_points))
      dwellings.points.push_back(site.position);
    if (dwellings.points.empty() && no_points.empty()) throw InputError(none_in(query, "dwelling"));
    if (dwellings.points.empty()) {
      dwellings.polygons = window_from_polygon(query.path, crs_);
    } else if (!no_points.empty()) {
      throw InputError(fmt::format("{}; give dwellings that are all points, or all polygons", no_points.front()));
    }
  }

  void read_demand() {
    viewshed::SiteDemand& demand = request_.demand;
    if (!options_.reads_demand()) return;
    if (is_raster(options_.demand)) {
      RasterValues weights = read_raster_values(options_.demand, crs_);
      demand.source = options_.demand;
      demand.grid = weights.grid, demand.weights = std::move(weights.values);
      return;
    }
    SiteQuery query = query_of(options_.demand, options_.demand_height_field);
    viewshed::SitePlaces begun = with_number(query, options_.weight_field, "weight", "--weight-field");
    take_names(query, LayerFields(query));
    demand.points = places_of(query, std::move(begun), [&](const Site& site, viewshed::SitePlace& point) {
      point.name = name_of(site, query);
      point.weight = number_of(site, 1);
    });
  }

  const SiteOptions& options_;
  const StoreMetadata& metadata_;
  const std::string& crs_;
  viewshed::SitePlanRequest request_;
};

}  // namespace

viewshed::SitePlanRequest complete_request(const SiteOptions& options, const StoreMetadata& metadata) {
  return RequestFiles(options, metadata).read();
}

}  // namespace itin::cli
