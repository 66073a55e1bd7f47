#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <vector>

#include <itin/parsed_number.hpp>
#include <itin/written_position.hpp>

#include "import/source/places/square_references.hpp"

namespace itin {

namespace {

constexpr double kSquare = 100000;  ///< the side of a square of two letters, metres

char upper(char c) {
  return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// The number of a letter counted from A, without I.
std::optional<int> letter_number(char c) {
  const char letter = upper(c);
  if (letter < 'A' || letter > 'Z' || letter == 'I') return std::nullopt;
  return letter - 'A' - (letter > 'I' ? 1 : 0);
}

double digits_value(std::string_view digits) {
  // Three digits are hundreds of metres.
  double value = 0, unit = kSquare;
  for (const char c : digits) value += (c - '0') * (unit /= 10);
  return value;
}

/// Reads an Ordnance Survey reference: squares of 500 km in rows of five from VAAAA, each of 25 squares of 100 km.
std::optional<Point2> national_grid(std::string_view text) {
  std::string compact;
  std::copy_if(text.begin(), text.end(), std::back_inserter(compact), [](char c) { return c != ' '; });
  if (compact.size() < 4 || compact.size() > 12 || compact.size() % 2 != 0) return std::nullopt;
  const auto large = letter_number(compact[0]), small = letter_number(compact[1]);
  const std::string_view digits = std::string_view(compact).substr(2);
  if (!large || !small || !std::all_of(digits.begin(), digits.end(), is_digit)) return std::nullopt;
  const int east = (*large % 5 - 2) * 5 + *small % 5, north = (3 - *large / 5) * 5 + 4 - *small / 5;
  if (east < 0 || east > 6 || north < 0 || north > 12) return std::nullopt;
  const std::size_t half = digits.size() / 2;
  return Point2{east * kSquare + digits_value(digits.substr(0, half)),
                north * kSquare + digits_value(digits.substr(half))};
}

/// Takes the number that the text begins with. A point or a comma between two digits is its decimal sign. Nothing for a
/// number with two of them: it cannot be told which is meant.
std::optional<double> take_number(std::string_view& text) {
  const auto is_sign_at = [&](std::size_t i) {
    return i > 0 && i + 1 < text.size() && (text[i] == '.' || text[i] == ',') && is_digit(text[i - 1]) &&
           is_digit(text[i + 1]);
  };
  std::string digits;
  for (std::size_t i = 0; i < text.size() && (is_digit(text[i]) || is_sign_at(i)); ++i)
    digits += is_digit(text[i]) ? text[i] : '.';
  text.remove_prefix(digits.size());
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

/// Reads the numbers of a text that has only marks (degrees, primes, colons, blanks) between them; nothing for a text
/// with letters.
std::optional<std::vector<double>> numbers_among_marks(std::string_view text) {
  std::vector<double> numbers;
  while (!text.empty()) {
    if (std::isalpha(static_cast<unsigned char>(text.front())) != 0) return std::nullopt;
    if (!is_digit(text.front())) {
      text.remove_prefix(1);
      continue;
    }
    const auto number = take_number(text);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::string_view without_blanks(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

/// Reads latitude and longitude as web maps copy them. The blank tells them from `x,y`.
std::optional<Point2> copied_degrees(std::string_view text) {
  if (text.find(", ") == std::string_view::npos) return std::nullopt;
  const auto pair = written_coordinates(text);
  if (!pair || std::abs(pair->x) > 90 || std::abs(pair->y) > 180) return std::nullopt;
  return Point2{pair->y, pair->x};
}

/// The position of the text's next hemisphere letter.
std::size_t next_letter(std::string_view text, std::size_t from) {
  return text.find_first_of("NSEWnsew", from);
}

}  // namespace

std::optional<double> written_angle(std::string_view text, char positive, char negative) {
  text = without_blanks(text);
  double sign = 1;
  bool lettered = false;
  if (!text.empty() && (upper(text.back()) == positive || upper(text.back()) == negative)) {
    sign = upper(text.back()) == negative ? -1 : 1, lettered = true;
    text.remove_suffix(1);
  }
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    if (lettered) return std::nullopt;
    sign = text.front() == '-' ? -1 : 1;
    text.remove_prefix(1);
  }
  const auto numbers = numbers_among_marks(text);
  if (!numbers || numbers->empty() || numbers->size() > 3) return std::nullopt;
  double degrees = 0, unit = 1;
  for (std::size_t i = 0; i < numbers->size(); ++i, unit /= 60) {
    const bool last = i + 1 == numbers->size();
    if ((i > 0 && (*numbers)[i] >= 60) || (!last && (*numbers)[i] != std::floor((*numbers)[i]))) return std::nullopt;
    degrees += (*numbers)[i] * unit;
  }
  return sign * degrees;
}

std::optional<Point2> written_coordinates(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto x = whole_text_as<double>(without_blanks(text.substr(0, comma))),
             y = whole_text_as<double>(without_blanks(text.substr(comma + 1)));
  if (!x || !y) return std::nullopt;
  return Point2{*x, *y};
}

std::optional<WrittenPosition> written_position(std::string_view text) {
  if (const auto degrees = copied_degrees(text)) return WrittenPosition{*degrees, "EPSG:4326"};
  if (const auto grid = national_grid(text)) return WrittenPosition{*grid, "EPSG:27700"};
  if (const auto square = military_grid(text)) return square;
  if (const auto square = maidenhead(text)) return square;
  const std::size_t first = next_letter(text, 0);
  if (first == std::string_view::npos) return std::nullopt;
  const std::size_t second = next_letter(text, first + 1);
  if (second == std::string_view::npos || text.find_first_not_of(' ', second + 1) != std::string_view::npos)
    return std::nullopt;
  std::string_view one = text.substr(0, first + 1), other = text.substr(first + 1, second - first);
  while (!other.empty() && (other.front() == ',' || other.front() == ' ')) other.remove_prefix(1);
  const char letter = upper(one.back());
  if (letter == 'E' || letter == 'W') std::swap(one, other);
  const auto latitude = written_angle(one, 'N', 'S'), longitude = written_angle(other, 'E', 'W');
  if (!latitude || !longitude || std::abs(*latitude) > 90 || std::abs(*longitude) > 180) return std::nullopt;
  return WrittenPosition{{*longitude, *latitude}, "EPSG:4326"};
}

}  // namespace itin
