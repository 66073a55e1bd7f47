#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/radio_text.hpp>

namespace itin::profile {

namespace {

/// Radio waves end at 3000 GHz by the ITU Radio Regulations, and links at about 300. Below a megahertz waves follow the
/// ground.
constexpr double kLeastGhz = 1e-3, kMostGhz = 300;

std::string lower_without_blanks(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\t') result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Returns a number of 0 or more; nothing for other text.
std::optional<double> unsigned_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value) || value < 0)
    return std::nullopt;
  return value;
}

std::optional<double> ratio(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return unsigned_number(text);
  const auto above = unsigned_number(text.substr(0, slash)), below = unsigned_number(text.substr(slash + 1));
  if (!above || !below || *below == 0) return std::nullopt;
  return *above / *below;
}

}  // namespace

double parse_frequency_ghz(std::string_view text) {
  const std::string given = lower_without_blanks(text);
  std::string_view digits = given;
  double unit = 1;
  for (const auto& [name, ghz] : {std::pair("ghz", 1.0), std::pair("mhz", 1e-3), std::pair("khz", 1e-6)}) {
    if (!digits.ends_with(name)) continue;
    digits.remove_suffix(3), unit = ghz;
    break;
  }
  const auto number = unsigned_number(digits);
  if (!number || *number == 0) throw InputError("no frequency; give GHz, such as 7.5, or 7500MHz");
  const bool bare = digits.size() == given.size();
  if (*number * unit < kLeastGhz) throw InputError(fmt::format("{:g} GHz is below radio links", *number * unit));
  if (*number * unit > kMostGhz)
    throw InputError(fmt::format("{:g} GHz is beyond radio links{}", *number * unit,
                                 bare ? fmt::format("; give GHz, {:g}, or {:g}MHz", *number / 1000, *number) : ""));
  // The division gives the number that a frequency in GHz would have: 7500 MHz is 7.5.
  return unit == 1 ? *number : unit == 1e-3 ? *number / 1e3 : *number / 1e6;
}

Criterion parse_criterion(std::string_view text) {
  const std::string given = lower_without_blanks(text);
  const std::size_t colon = given.find(':');
  const std::string_view factor = std::string_view(given).substr(0, colon);
  const bool fade = factor == "ke";
  const auto k = fade ? std::optional(Criterion().k) : ratio(factor);
  const auto fraction =
      colon == std::string::npos ? std::nullopt : unsigned_number(std::string_view(given).substr(colon + 1));
  if (!k || *k == 0 || !fraction) throw InputError("expected K:fraction, such as 4/3:1.0 or ke:0.3");
  return {*k, *fraction, fade};
}

std::string factor_text(const Criterion& criterion, double k) {
  return fmt::format("{:.4g}{}", k, criterion.fade ? " (ke)" : "");
}

Polarisation parse_polarisation(std::string_view text) {
  const std::string given = lower_without_blanks(text);
  if (given == "h" || given == "horizontal") return Polarisation::kHorizontal;
  if (given == "v" || given == "vertical") return Polarisation::kVertical;
  throw InputError("expected h or v");
}

}  // namespace itin::profile
