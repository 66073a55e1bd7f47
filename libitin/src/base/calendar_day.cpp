#include <array>
#include <cctype>
#include <charconv>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <itin/calendar_day.hpp>

namespace itin {

namespace {

constexpr std::array<std::string_view, 12> kMonths{"January",   "February", "March",    "April",
                                                   "May",       "June",     "July",     "August",
                                                   "September", "October",  "November", "December"};

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    if (end != 0 && !text.empty()) parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value > 0 ? std::optional(value) : std::nullopt;
}

bool begins(std::string_view whole, std::string_view part) {
  if (part.size() > whole.size()) return false;
  for (std::size_t i = 0; i < part.size(); ++i)
    if (std::tolower(static_cast<unsigned char>(whole[i])) != std::tolower(static_cast<unsigned char>(part[i])))
      return false;
  return true;
}

std::optional<int> month_number(std::string_view name) {
  for (std::size_t i = 0; i < kMonths.size(); ++i)
    if ((name.size() == 3 || name.size() == kMonths[i].size()) && begins(kMonths[i], name))
      return static_cast<int>(i) + 1;
  return std::nullopt;
}

}  // namespace

std::optional<CalendarDay> parse_day(std::string_view text) {
  const bool iso = text.find('-') != std::string_view::npos;
  const std::vector<std::string_view> parts = parts_of(text, iso ? '-' : ' ');
  if (parts.size() != 3) return std::nullopt;
  const auto year = whole_number(iso ? parts[0] : parts[2]), day = whole_number(iso ? parts[2] : parts[0]);
  const auto month = iso ? whole_number(parts[1]) : month_number(parts[1]);
  if (!year || !month || !day) return std::nullopt;
  const CalendarDay result{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                           std::chrono::day(static_cast<unsigned>(*day))};
  return result.ok() ? std::optional(result) : std::nullopt;
}

std::string day_text(const CalendarDay& day) {
  return fmt::format("{} {} {}", static_cast<unsigned>(day.day()), kMonths[static_cast<unsigned>(day.month()) - 1],
                     static_cast<int>(day.year()));
}

std::string iso_day_text(const CalendarDay& day) {
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                     static_cast<unsigned>(day.day()));
}

double decimal_year(const CalendarDay& day) {
  using namespace std::chrono;
  const auto first = [](year y) { return sys_days(y / January / 1); };
  const auto over = sys_days(day) - first(day.year());
  const auto whole = first(day.year() + years(1)) - first(day.year());
  return static_cast<int>(day.year()) + static_cast<double>(over.count()) / static_cast<double>(whole.count());
}

}  // namespace itin
