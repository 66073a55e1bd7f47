#include "program/values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <itin/height_limit.hpp>
#include <itin/written_position.hpp>

namespace itin::cli {

namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string_view expected) {
  throw InputError(fmt::format("{} '{}': {}", option, text, expected));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

}  // namespace

double parse_bearing(std::string_view option, std::string_view text) {
  const double bearing = parse_number(option, text, Range::kNotNegative);
  if (bearing > 360) refuse(option, text, "give a bearing from 0 to 360 degrees");
  return bearing;
}

double parse_radius(std::string_view option, std::string_view text) {
  const double radius = parse_number(option, text, Range::kPositive);
  if (radius > kFarthest)
    refuse(option, text, fmt::format("farther than any ground; give at most {:.0f} metres", kFarthest));
  return radius;
}

double parse_ratio(std::string_view option, std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return parse_number(option, text, Range::kPositive);
  const std::optional<double> above = whole_text_as<double>(text.substr(0, slash));
  const std::optional<double> below = whole_text_as<double>(text.substr(slash + 1));
  if (!above || !below || *above <= 0 || *below <= 0) refuse(option, text, "expected a positive number or ratio a/b");
  return *above / *below;
}

int parse_whole(std::string_view option, std::string_view text, int least, int most) {
  const std::optional<int> value = whole_text_as<int>(text);
  if (!value || *value < least || *value > most) {
    refuse(option, text, fmt::format("expected a whole number from {} to {}", least, most));
  }
  return *value;
}

std::vector<double> parse_numbers(std::string_view option, std::string_view text, Range range) {
  std::vector<double> values;
  for (const std::string_view part : split(text, ',')) values.push_back(parse_number(option, part, range));
  return values;
}

std::vector<double> parse_heights(std::string_view option, std::string_view text, Range range) {
  std::vector<double> values;
  for (const std::string_view part : split(text, ',')) values.push_back(parse_height(option, part, range));
  return values;
}

std::vector<double> parse_tuple(std::string_view option, std::string_view text, std::size_t count,
                                std::string_view shape) {
  const std::vector<std::string_view> parts = split(text, ',');
  std::vector<double> values;
  for (const std::string_view part : parts) {
    const std::optional<double> value = whole_text_as<double>(part);
    if (!value || parts.size() != count) refuse(option, text, fmt::format("expected {}", shape));
    values.push_back(*value);
  }
  return values;
}

std::vector<int> parse_wholes(std::string_view option, std::string_view text, int least, int most) {
  std::vector<int> values;
  for (const std::string_view part : split(text, ',')) values.push_back(parse_whole(option, part, least, most));
  return values;
}

std::uint64_t parse_bytes(std::string_view option, std::string_view text) {
  constexpr std::string_view kUnits = "KMGT";
  std::string_view digits = text;
  double factor = 1;
  if (!digits.empty()) {
    const std::size_t unit = kUnits.find(static_cast<char>(std::toupper(static_cast<unsigned char>(digits.back()))));
    if (unit != std::string_view::npos) {
      factor = std::ldexp(1.0, 10 * (static_cast<int>(unit) + 1));
      digits.remove_suffix(1);
    }
  }
  constexpr double kMost = 1e18;
  const std::optional<double> value = whole_text_as<double>(digits);
  if (!value || *value * factor < 1 || *value * factor > kMost) {
    refuse(option, text, "expected a number of bytes, for instance 500M or 4G");
  }
  return static_cast<std::uint64_t>(*value * factor);
}

bool parse_switch(std::string_view option, std::string_view text) {
  return parse_choice(option, text, {"off", "on"}) == 1;
}

std::size_t parse_choice(std::string_view option, std::string_view text, const std::vector<std::string_view>& choices) {
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == text) return i;
  }
  refuse(option, text, fmt::format("expected one of {}", fmt::join(choices, ", ")));
}

Box parse_box(std::string_view option, std::string_view text) {
  constexpr std::string_view kShape = "xmin,ymin,xmax,ymax";
  const std::vector<double> v = parse_tuple(option, text, 4, kShape);
  const Box box{v[0], v[1], v[2], v[3]};
  if (box.xmin >= box.xmax || box.ymin >= box.ymax) {
    refuse(option, text, fmt::format("expected {} with xmin < xmax and ymin < ymax", kShape));
  }
  return box;
}

std::vector<Ring> parse_rings(std::string_view option, std::string_view text) {
  std::vector<Ring> rings;
  for (const std::string_view part : split(text, ',')) {
    const std::vector<std::string_view> pair = split(part, ':');
    if (pair.size() != 2) refuse(option, text, "expected radius:tolerance,..., for instance 500:0,2000:1");
    rings.push_back(
        {parse_number(option, pair[0], Range::kPositive), parse_number(option, pair[1], Range::kNotNegative)});
    if (rings.size() > 1) {
      const Ring& inner = rings[rings.size() - 2];
      if (rings.back().radius <= inner.radius || rings.back().tolerance < inner.tolerance) {
        refuse(option, text, "expected growing radii and tolerances, nearest ring first");
      }
    }
  }
  return rings;
}

namespace {

/// Reads a position that states its CRS itself, and a height behind a comma.
std::optional<Place> written_place(std::string_view option, std::string_view text) {
  if (const auto alone = written_position(text)) return Place{alone->position, std::nullopt, alone->crs};
  const std::size_t comma = text.rfind(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto position = written_position(text.substr(0, comma));
  if (!position) return std::nullopt;
  std::string_view height = text.substr(comma + 1);
  while (height.starts_with(' ')) height.remove_prefix(1);
  return Place{position->position, parse_height(option, height), position->crs};
}

/// Returns the text without blanks in front, and behind its commas.
std::string without_blanks_behind_commas(std::string_view text) {
  std::string compact;
  for (const char c : text)
    if (c != ' ' || (!compact.empty() && compact.back() != ',')) compact += c;
  return compact;
}

}  // namespace

Place parse_place(std::string_view option, std::string_view text) {
  constexpr std::string_view kShape =
      "x,y or x,y,h; for x,y also degrees with N, S, E or W, or an OS grid reference such as ST1037583525, or latitude "
      "and longitude as '51.5437, -3.2934'";
  if (const auto written = written_place(option, text)) return *written;
  const std::string compact = without_blanks_behind_commas(text);
  const bool with_height = split(compact, ',').size() == 3;
  const std::vector<double> v = parse_tuple(option, compact, with_height ? 3 : 2, kShape);
  Place place{{v[0], v[1]}, std::nullopt};
  if (with_height) place.height = v[2];
  require_height(place.height.value_or(0), fmt::format("{} '{}'", option, text));
  return place;
}

bool may_be_place(std::string_view text) {
  if (written_position(text) || written_position(text.substr(0, text.rfind(',')))) return true;
  const std::string compact = without_blanks_behind_commas(text);
  const std::vector<std::string_view> parts = split(compact, ',');
  return (parts.size() == 2 || parts.size() == 3) && whole_text_as<double>(parts[0]).has_value();
}

}  // namespace itin::cli
