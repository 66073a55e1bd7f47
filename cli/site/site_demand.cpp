#include "site/site_demand.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/raster_values.hpp>
#include <itin/sites.hpp>

#include "options/off_the_data.hpp"
#include "options/site_list.hpp"
#include "output/store_document.hpp"

namespace itin::cli {

namespace {

class DemandReader {
 public:
  DemandReader(const Store& store, const SiteOptions& options, SiteInputs& inputs, Progress& progress)
      : store_(store), options_(options), crs_(store.metadata().crs_wkt), inputs_(inputs), progress_(progress) {}

  void read() {
    inputs_.targets.height = options_.target_height;
    inputs_.targets.on_surface = options_.targets_on_surface;
    if (options_.demand == "cells") {
      read_cells();
    } else if (is_raster(options_.demand)) {
      read_weights(read_raster_values(options_.demand, crs_));
    } else {
      read_points();
    }
    if (inputs_.total == 0) throw InputError("there is no demand within the data: nothing to serve");
  }

 private:
  void read_cells() {
    const std::vector<viewshed::SitePosition> of_options(
        inputs_.positions.begin(), inputs_.positions.begin() + static_cast<std::ptrdiff_t>(inputs_.options.size()));
    const RasterGrid grid = viewshed::grid_of_reach(store_, of_options, options_.radius, options_.cell_size());
    inputs_.targets.grid = grid;
    inputs_.demand = viewshed::Demand(viewshed::element_count(grid));
    const viewshed::DemandSet ground = viewshed::with_ground(store_, inputs_.targets, progress_);
    inputs_.cells = intersection(ground, viewshed::within_reach(inputs_.targets, of_options, options_.radius));
    inputs_.total = inputs_.demand.weight(inputs_.cells);
  }

  void read_weights(RasterValues weights) {
    const RasterGrid& grid = weights.grid;
    inputs_.targets.grid = grid;
    std::vector<double> of_element(viewshed::element_count(grid));
    for (std::int64_t row = 0; row < grid.rows(); ++row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        const double value = weights.values[grid.index({column, row})];
        if (!std::isnan(value)) of_element[viewshed::element_of(grid, {column, row})] = value;
      }
    }
    try {
      inputs_.demand = viewshed::Demand(of_element);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", options_.demand, error.what()));
    }
    inputs_.total = inputs_.demand.total();
  }

  /// A place to serve.
  struct Target {
    Point2 position;
    double weight, height;
  };

  void read_points() {
    SiteQuery query;
    query.path = options_.demand;
    query.crs = options_.in_crs.crs;
    query.height_field = options_.demand_height_field;
    if (options_.weight_field.empty()) {
      warn_of_unused(query, LayerFields(query), "weight", "--weight-field", inputs_.warnings);
    } else {
      query.numbers.push_back({options_.weight_field});
    }
    std::vector<Target> targets = targets_of(query);
    if (targets.empty()) throw InputError(query.path + ": holds no point to serve");
    sort_by_place(targets);
    std::vector<double> weights;
    for (const Target& target : targets) {
      inputs_.targets.points.push_back(target.position);
      if (!query.height_field.empty()) inputs_.targets.heights.push_back(target.height);
      weights.push_back(target.weight);
    }
    inputs_.demand = viewshed::Demand(weights);
    inputs_.total = inputs_.demand.total();
    const std::size_t on_ground = viewshed::with_ground(store_, inputs_.targets, progress_).size();
    inputs_.demand_without_ground = targets.size() - on_ground;
    if (on_ground == 0 && !options_.placement.given())
      throw InputError(fmt::format("{}: none of its {} has ground data below it; the data is {}", query.path,
                                   counted(targets.size(), "point"), extent_of(store_.metadata())));
  }

  std::vector<Target> targets_of(const SiteQuery& query) {
    std::vector<Target> targets;
    for (const Site& site : read_sites(query, crs_, inputs_.warnings, inputs_.rejected)) {
      const double weight = site.numbers.empty() ? 1 : site.numbers.front().value_or(-1);
      const double height = site.height.value_or(options_.target_height);
      const char* const wrong = !(weight >= 0) ? "its weight is missing or negative"
                                : height < 0   ? "its height is negative"
                                : height == 0 && options_.frequency_ghz
                                    ? "its height is 0: no link to the ground is clear"
                                    : nullptr;
      if (wrong == nullptr) {
        targets.push_back({site.position, weight, height});
      } else {
        inputs_.rejected.push_back(fmt::format("{}: {}: {}", query.path, site.place, wrong));
      }
    }
    return targets;
  }

  /// Sorts the points in strips, each from west to east, so that neighbours are next to each other: their sight lines
  /// are judged together.
  static void sort_by_place(std::vector<Target>& targets) {
    Box box;
    for (const Target& target : targets) box.extend(target.position);
    const double strip =
        std::max(box.height() / std::max(1.0, std::sqrt(static_cast<double>(targets.size()) / 8)), 1e-3);
    std::stable_sort(targets.begin(), targets.end(), [&](const Target& one, const Target& other) {
      const Point2 a = one.position, b = other.position;
      const double sa = std::floor((a.y - box.ymin) / strip), sb = std::floor((b.y - box.ymin) / strip);
      return sa != sb ? sa < sb : a.x != b.x ? a.x < b.x : a.y < b.y;
    });
  }

  const Store& store_;
  const SiteOptions& options_;
  std::string crs_;
  SiteInputs& inputs_;
  Progress& progress_;
};

}  // namespace

void read_site_demand(const Store& store, const SiteOptions& options, SiteInputs& inputs, Progress& progress) {
  DemandReader(store, options, inputs, progress).read();
}

}  // namespace itin::cli
