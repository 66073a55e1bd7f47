#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <fstream>
#include <tuple>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/grazing.hpp>
#include <itin/parallel.hpp>
#include <itin/paths.hpp>
#include <itin/store.hpp>
#include <profile/links.hpp>
#include <profile/profile.hpp>

#include "line_clearance.hpp"
#include "link_sharing.hpp"

namespace itin::profile {

namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\r' && c != '"') {
      cells.back() += c;
    }
  }
  return cells;
}

double number(const std::string& text) {
  const char* first = text.c_str() + std::min(text.find_first_not_of(' '), text.size());
  const char* last = text.c_str() + text.size();
  double value = 0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value))
    throw InputError(fmt::format("'{}' is no number; the columns are id,x1,y1,h1,x2,y2,h2", text));
  return value;
}

Link link_of(const std::string& line) {
  const std::vector<std::string> cells = cells_of(line);
  if (cells.size() != 7) throw InputError(fmt::format("has {} columns instead of 7", cells.size()));
  std::array<double, 6> v{};
  for (std::size_t i = 0; i < 6; ++i) v[i] = number(cells[i + 1]);
  return {cells[0], {v[0], v[1]}, v[2], {v[3], v[4]}, v[5]};
}

/// Calls refuse(number of the row, number of its line, what is wrong) for those that cannot be understood.
template <class Refuse>
std::vector<Link> read_table(const std::string& path, const std::string& to_crs, const std::string& csv_crs,
                             const Refuse& refuse) {
  std::ifstream file(path);
  if (!file) throw FileError(path, "cannot be opened");
  std::optional<CoordinateTransform> transform;
  if (!csv_crs.empty()) transform.emplace(csv_crs, to_crs);
  std::vector<Link> links;
  std::string line;
  std::size_t row = 0;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    if (number == 1 || line.find_first_not_of(" \r") == std::string::npos) continue;
    ++row;
    try {
      Link link = link_of(line);
      if (transform) link.from = (*transform)(link.from), link.to = (*transform)(link.to);
      links.push_back(std::move(link));
    } catch (const InputError& error) {
      refuse(row, number, error.what());
    }
  }
  return links;
}

bool is_table(const std::string& path) {
  return path.size() > 4 && path.ends_with(".csv");
}

std::vector<Link> read_lines(const std::string& path, const std::string& to_crs, double height) {
  std::vector<Link> links;
  for (const Path& line : read_paths(path, to_crs))
    links.push_back({line.name, line.corners.front(), height, line.corners.back(), height});
  return links;
}

/// The surface, and where features stand on it the ground under them.
class Surfaces {
 public:
  Surfaces(const Store& store, const LinkQuery& query, const std::vector<Link>& links)
      : store_(store), query_(query), standing_(query.themes.includes_standing(store.metadata().themes)) {
    if (standing_ || sharing_pays(store, query.detail, links)) surface_.emplace(store, query.detail, query.themes);
    if (standing_) ground_.emplace(store, query.detail);
  }

  LinkResult survey(const Link& link) const {
    const Profile profile = from_section(surface_ ? surface_->between(link.from, link.to)
                                                  : cross_section(store_, link.from, link.to, query_.detail));
    LinkResult result;
    result.distance_m = profile.length_m;
    if (!has_ground_at_ends(profile)) {
      result.message = "no ground under an end";
      return result;
    }
    std::optional<Profile> bare;
    if (ground_) bare = from_section(ground_->between(link.from, link.to));
    const EndGrounds grounds = grounds_of(profile, bare);
    const Antennas antennas{grounds.from_m + link.from_height, grounds.to_m + link.to_height};
    const auto line = line_clearance(profile, antennas, query_.earth);
    const bool blocked = query_.gaps_block && !profile.gaps.empty();
    const bool hidden = profile.length_m > 0 && line->clearance_m < -kGrazing;
    result.verdict = hidden || blocked ? SightVerdict::kHidden : SightVerdict::kVisible;
    result.clearance_m = line->clearance_m;
    result.critical_m = line->critical.distance_m;
    if (query_.radio && profile.length_m > 0) add_radio(profile, bare ? &*bare : nullptr, antennas, result);
    return result;
  }

 private:
  EndGrounds grounds_of(const Profile& profile, const std::optional<Profile>& bare) const {
    EndGrounds grounds = ends_of(profile);
    if (bare && !query_.from_on_surface) grounds.from_m = ends_of(*bare).from_m;
    if (bare && !query_.to_on_surface) grounds.to_m = ends_of(*bare).to_m;
    return grounds;
  }

  void add_radio(const Profile& profile, const Profile* bare, const Antennas& antennas, LinkResult& result) const {
    const auto fresnel = fresnel_clearance(profile, antennas, query_.earth, wavelength_m(query_.radio->frequency_ghz));
    if (fresnel) result.fresnel_fraction = fresnel->fraction;
    const EndGrounds top = ends_of(profile);
    if (antennas.from_m < top.from_m || antennas.to_m < top.to_m) return;
    // The same points as in a report (los.cpp).
    const Profile dense = with_spacing(profile, std::min(100.0, profile.length_m / 50));
    result.ld_db = path_losses(dense, antennas, *query_.radio, bare).ld_db;
  }

  const Store& store_;
  const LinkQuery& query_;
  bool standing_;
  std::optional<SectionSurface> surface_;  ///< where none, every link is retrieved by itself
  std::optional<SectionSurface> ground_;
};

/// Links that lie near each other come near each other, so that what one has read is at hand for the next.
std::vector<std::size_t> by_place(const std::vector<Link>& links) {
  constexpr double kSide = 5000;
  const auto cell = [](double v) { return static_cast<std::int64_t>(std::floor(v / kSide)); };
  std::vector<std::tuple<std::int64_t, std::int64_t, std::size_t>> order;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const std::int64_t row = cell((links[i].from.y + links[i].to.y) / 2);
    const std::int64_t column = cell((links[i].from.x + links[i].to.x) / 2);
    order.emplace_back(row, row % 2 == 0 ? column : -column, i);  // there and back again
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> places;
  for (const auto& [row, column, i] : order) places.push_back(i);
  return places;
}

}  // namespace

std::vector<Link> read_links(const std::string& path, const std::string& to_crs, double height,
                             const std::string& csv_crs) {
  if (!is_table(path)) return read_lines(path, to_crs, height);
  return read_table(path, to_crs, csv_crs, [&](std::size_t, std::size_t line, const std::string& message) {
    throw FileError(path, fmt::format("line {}: {}", line, message));
  });
}

LinkTable read_link_table(const std::string& path, const std::string& to_crs, double height,
                          const std::string& csv_crs) {
  if (!is_table(path)) return {read_lines(path, to_crs, height), {}};
  LinkTable table;
  table.links = read_table(path, to_crs, csv_crs, [&](std::size_t row, std::size_t, const std::string& message) {
    table.bad.push_back({row, message});
  });
  return table;
}

std::vector<LinkResult> survey_links(const Store& store, const std::vector<Link>& links, const LinkQuery& query,
                                     Progress& progress) {
  const Surfaces surfaces(store, query, links);
  const std::vector<std::size_t> order = by_place(links);
  std::vector<LinkResult> results(links.size());
  std::atomic<std::size_t> done = 0;
  constexpr std::size_t kBatch = 64;
  parallel_for((links.size() + kBatch - 1) / kBatch, [&](std::size_t batch) {
    progress.throw_if_cancelled();
    const std::size_t end = std::min(links.size(), (batch + 1) * kBatch);
    for (std::size_t k = batch * kBatch; k < end; ++k) {
      const std::size_t i = order[k];
      try {
        results[i] = surfaces.survey(links[i]);
      } catch (const InputError& error) {
        results[i] = {};
        results[i].message = error.what();
      }
    }
    done += end - batch * kBatch;
    progress.report("links", static_cast<double>(done) / static_cast<double>(links.size()));
  });
  return results;
}

}  // namespace itin::profile
