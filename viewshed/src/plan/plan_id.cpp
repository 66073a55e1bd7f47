#include "plan/plan_id.hpp"

#include <string>

#include <fmt/format.h>

#include <itin/packed_file.hpp>

namespace itin::viewshed {

namespace {

/// Writes values one after the other as text, numbers to the last bit.
class Text {
 public:
  template <class... Values>
  void add(const Values&... values) {
    (put(values), ...);
  }
  std::uint64_t hash() const { return content_hash(text_); }

 private:
  void put(double v) { text_ += fmt::format("{:a};", v); }
  void put(std::uint64_t v) { text_ += fmt::format("{};", v); }
  void put(std::int64_t v) { text_ += fmt::format("{};", v); }
  void put(std::uint32_t v) { put(std::uint64_t{v}); }
  void put(bool v) { put(std::uint64_t{v}); }
  template <class E>
  requires std::is_enum_v<E>
  void put(E v) { put(static_cast<std::uint64_t>(v)); }
  void put(const std::string& v) { text_ += fmt::format("{}:{};", v.size(), v); }
  void put(Point2 v) { add(v.x, v.y); }
  void put(const AngleRange& v) { add(v.from, v.to); }
  void put(const Ring& v) { add(v.radius, v.tolerance); }
  void put(const Box& v) { add(v.xmin, v.ymin, v.xmax, v.ymax); }
  template <class T>
  void put(const std::optional<T>& v) {
    put(v.has_value());
    if (v) put(*v);
  }
  template <class T>
  void put(const std::vector<T>& all) {
    put(std::uint64_t{all.size()});
    for (const T& v : all) put(v);
  }

  // Every field of these is named, so that a new one cannot be forgotten.
  void put(const Observer& v) {
    const auto& [name, position, height, absolute, target_height, radius, min_radius, azimuth, elevation, antenna] = v;
    add(name, position, height, absolute, target_height, radius, min_radius, azimuth, elevation, antenna);
  }
  void put(const Earth& v) {
    const auto& [curvature, refraction, radius, effective_factor] = v;
    add(curvature, refraction, radius, effective_factor);
  }
  void put(const VerticalError& v) {
    const auto& [sigma, correlation_length] = v;
    add(sigma, correlation_length);
  }
  void put(const FresnelCriterion& v) {
    const auto& [wavelength, fraction] = v;
    add(wavelength, fraction);
  }
  void put(const RadioPath& v) {
    const auto& [frequency_ghz, effective_earth_km, polarisation, over_sea] = v;
    add(frequency_ghz, effective_earth_km, polarisation, over_sea);
  }
  void put(const profile::AntennaPattern& v) { add(v.horizontal, v.vertical, v.gain_dbi); }
  void put(const std::pair<double, double>& v) { add(v.first, v.second); }
  void put(const profile::AimedAntenna& v) {
    const auto& [pattern, azimuth_deg, tilt_deg] = v;
    add(pattern ? std::optional(*pattern) : std::nullopt, azimuth_deg, tilt_deg);
  }
  void put(const profile::BudgetQuery& v) {
    const auto& [power, eirp, from_gain, to_gain, from_feeder, to_feeder, sensitivity, rain, factor, gradient,
                 from_antenna, to_antenna] = v;
    add(power, eirp, from_gain, to_gain, from_feeder, to_feeder, sensitivity, rain, factor, gradient, from_antenna,
        to_antenna);
  }
  void put(const OmittedFeature& v) {
    const auto& [theme, number, theme_name, name, id] = v;
    add(std::uint64_t{theme}, number, theme_name, name, id);
  }
  void put(const Segment& v) {
    const auto& [north_west, columns, rows, observers, distance_m, points] = v;
    add(north_west.column, north_west.row, columns, rows, observers, distance_m, points);
  }

  std::string text_;
};

void add_request(Text& text, const Request& request, const std::vector<ThemeInfo>& themes) {
  const auto& [observers, target_height, target_absolute, radius, min_radius, azimuth, elevation, cell_size, grid,
               finest_default_cell, earth, detail, choice, observers_on_surface, targets_on_surface, nodata, engine,
               mode, vertical_error, fresnel, radio, budget, margins] = request;
  // The plan's grid has the cells that `grid` and `finest_default_cell` lead to.
  text.add(observers, target_height, target_absolute, radius, min_radius, azimuth, elevation, cell_size,
           grid.has_value(), earth, detail.centre(), detail.rings(), choice.names(themes), choice.omitted(),
           observers_on_surface, targets_on_surface, nodata, engine, mode, vertical_error, fresnel, radio, budget,
           margins);
}

/// A digest of the store's content would take reading all of it.
void add_store(Text& text, const StoreMetadata& store) {
  text.add(store.crs_wkt, store.grid.origin, store.grid.resolution, store.vertices);
  for (const LevelInfo& level : store.levels)
    text.add(level.tolerance, level.lateral_tolerance, level.vertices, level.certified_error.lo,
             level.certified_error.hi);
  for (const SourceInfo& source : store.sources) text.add(source.path, source.theme, source.sha256, source.vertices);
  for (const ThemeInfo& theme : store.themes) text.add(theme.name, theme.features, theme.vertices, theme.segments);
}

}  // namespace

std::uint64_t id_of(const StoreMetadata& store) {
  Text text;
  add_store(text, store);
  return text.hash();
}

std::uint64_t id_of(const StoreMetadata& store, const Plan& plan) {
  Text text;
  add_store(text, store);
  add_request(text, plan.request(), store.themes);
  const RasterGrid& grid = plan.grid();
  text.add(plan.certainty(), plan.decides_exactly(), grid.north_west(), grid.cell_width(), grid.cell_height(),
           grid.columns(), grid.rows(), plan.segments());
  return text.hash();
}

}  // namespace itin::viewshed
