#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/data_extent.hpp>
#include <itin/error.hpp>

#include "workflows/siting/request_rules.hpp"
#include "workflows/siting/site_inputs.hpp"
#include "workflows/siting/site_premises.hpp"

namespace itin::viewshed {

namespace {

/// A point to serve.
struct PointToServe {
  Point2 position;
  double height;
  DemandPoint known;
};

/// Tells why a point cannot be served; nothing where it may be.
const char* wrong_with(const PointToServe& point, bool radio) {
  if (!(point.known.weight >= 0)) return "its weight is missing or negative";
  if (point.height < 0) return "its height is negative";
  return point.height == 0 && radio ? "its height is 0: no link to the ground is clear" : nullptr;
}

/// Sorts the points in strips, each from west to east, so that neighbours are next to each other: their sight lines are
/// judged together.
void sort_by_place(std::vector<PointToServe>& points) {
  Box box;
  for (const PointToServe& point : points) box.extend(point.position);
  const double strip = std::max(box.height() / std::max(1.0, std::sqrt(static_cast<double>(points.size()) / 8)), 1e-3);
  std::stable_sort(points.begin(), points.end(), [&](const PointToServe& one, const PointToServe& other) {
    const Point2 a = one.position, b = other.position;
    const double sa = std::floor((a.y - box.ymin) / strip), sb = std::floor((b.y - box.ymin) / strip);
    return sa != sb ? sa < sb : a.x != b.x ? a.x < b.x : a.y < b.y;
  });
}

class DemandOfPlan {
 public:
  DemandOfPlan(const Store& store, const SitePlanRequest& request, SiteInputs& inputs,
               std::vector<std::string>& warnings, Progress& progress)
      : store_(store),
        request_(request),
        given_(request.demand),
        inputs_(inputs),
        warnings_(warnings),
        progress_(progress) {}

  void add() {
    inputs_.targets.height = given_.height;
    inputs_.targets.on_surface = given_.on_surface && !given_.premises;
    if (given_.points) {
      add_points();
    } else if (given_.premises) {
      add_premises(store_, request_, inputs_, warnings_, progress_);
    } else if (given_.grid) {
      add_weights();
    } else {
      add_cells();
    }
    if (inputs_.total == 0) throw InputError("there is no demand within the data: nothing to serve", "demand");
  }

 private:
  void add_cells() {
    const std::vector<SitePosition> of_options(
        inputs_.positions.begin(), inputs_.positions.begin() + static_cast<std::ptrdiff_t>(inputs_.options.size()));
    const RasterGrid grid = grid_of_reach(store_, of_options, request_.radius, request_.cell_size);
    inputs_.targets.grid = grid;
    inputs_.demand = Demand(element_count(grid));
    const DemandSet ground = with_ground(store_, inputs_.targets, progress_);
    inputs_.cells = intersection(ground, within_reach(inputs_.targets, of_options, request_.radius));
    inputs_.total = inputs_.demand.weight(inputs_.cells);
  }

  void add_weights() {
    const RasterGrid& grid = *given_.grid;
    inputs_.targets.grid = grid;
    std::vector<double> of_element(element_count(grid));
    for (std::int64_t row = 0; row < grid.rows(); ++row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        const double value = given_.weights[grid.index({column, row})];
        if (!std::isnan(value)) of_element[element_of(grid, {column, row})] = value;
      }
    }
    try {
      inputs_.demand = Demand(of_element);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", given_.source.empty() ? "`weights`" : given_.source, error.what()),
                       "weights");
    }
    inputs_.total = inputs_.demand.total();
  }

  void add_points() {
    std::vector<PointToServe> points = points_to_serve();
    const std::string source = name_of(*given_.points, "demand");
    if (points.empty()) throw InputError(source + ": holds no point to serve", "demand");
    sort_by_place(points);
    const std::vector<SitePlace>& places = given_.points->places;
    const bool own_heights = std::any_of(places.begin(), places.end(), [](const SitePlace& p) { return p.height; });
    std::vector<double> weights;
    for (const PointToServe& point : points) {
      inputs_.targets.points.push_back(point.position);
      if (own_heights) inputs_.targets.heights.push_back(point.height);
      weights.push_back(point.known.weight);
      inputs_.points.push_back(point.known);
    }
    inputs_.demand = Demand(weights);
    inputs_.total = inputs_.demand.total();
    const std::size_t on_ground = with_ground(store_, inputs_.targets, progress_).size();
    inputs_.demand_without_ground = points.size() - on_ground;
    if (on_ground == 0 && !request_.turbines)
      throw InputError(fmt::format("{}: none of its {} has ground data below it; the data is {}", source,
                                   counted(points.size(), "point"), extent_of(store_.metadata())),
                       "demand");
  }

  std::vector<PointToServe> points_to_serve() {
    const std::vector<std::string>& left_out = given_.points->left_out;
    inputs_.left_out.insert(inputs_.left_out.end(), left_out.begin(), left_out.end());
    std::vector<PointToServe> points;
    for (std::size_t i = 0; i < given_.points->places.size(); ++i) {
      const SitePlace& place = given_.points->places[i];
      points.push_back({place.position,
                        place.height.value_or(given_.height),
                        {place.name.empty() ? std::to_string(i) : place.name, i, place.weight}});
      if (const char* const wrong = wrong_with(points.back(), request_.frequency_ghz.has_value())) {
        inputs_.left_out.push_back(name_of(*given_.points, "demand", place) + ": " + wrong);
        points.pop_back();
      }
    }
    return points;
  }

  const Store& store_;
  const SitePlanRequest& request_;
  const SiteDemand& given_;
  SiteInputs& inputs_;
  std::vector<std::string>& warnings_;
  Progress& progress_;
};

}  // namespace

void add_demand(const Store& store, const SitePlanRequest& request, SiteInputs& inputs,
                std::vector<std::string>& warnings, Progress& progress) {
  DemandOfPlan(store, request, inputs, warnings, progress).add();
  if (request.demand.points)
    warnings.insert(warnings.end(), request.demand.points->warnings.begin(), request.demand.points->warnings.end());
}

}  // namespace itin::viewshed
