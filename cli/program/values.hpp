// Reads option values: numbers, lists, sizes, points and rings from text; strictly, and whatever the locale.
//
// `option` is what the error calls the value, for instance "--radius". Every function throws InputError, in one line:
// which option, what was given, what was expected.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <itin/detail.hpp>
#include <itin/error.hpp>
#include <itin/geometry.hpp>
#include <itin/parsed_number.hpp>

namespace itin::cli {

/// The numbers that an option takes.
using Range = NumberRange;

/// Reads degrees clockwise from north, 0 to 360.
double parse_bearing(std::string_view option, std::string_view text);

/// A distance in metres that is farther than any ground reaches.
inline constexpr double kFarthest = 1e9;

/// Reads how far to look: a positive number of metres, at most kFarthest.
double parse_radius(std::string_view option, std::string_view text);

/// Reads a ratio `a/b`, or a number; positive.
double parse_ratio(std::string_view option, std::string_view text);

/// Reads a whole number in [least, most].
int parse_whole(std::string_view option, std::string_view text, int least, int most);

/// Reads numbers separated by commas, at least one.
std::vector<double> parse_numbers(std::string_view option, std::string_view text, Range range = Range::kAny);

/// Reads heights in metres, separated by commas, at least one.
std::vector<double> parse_heights(std::string_view option, std::string_view text, Range range = Range::kAny);

/// Reads exactly `count` numbers separated by commas; `shape` is the expected form, for instance "x,y,r".
std::vector<double> parse_tuple(std::string_view option, std::string_view text, std::size_t count,
                                std::string_view shape);

/// Reads whole numbers in [least, most] separated by commas, at least one.
std::vector<int> parse_wholes(std::string_view option, std::string_view text, int least, int most);

/// Reads bytes, with an optional K, M, G or T for powers of 1024.
std::uint64_t parse_bytes(std::string_view option, std::string_view text);

/// Reads `on` or `off`.
bool parse_switch(std::string_view option, std::string_view text);

/// Returns the index in `choices` of `text`.
std::size_t parse_choice(std::string_view option, std::string_view text, const std::vector<std::string_view>& choices);

/// Reads `xmin,ymin,xmax,ymax` with xmin < xmax and ymin < ymax.
Box parse_box(std::string_view option, std::string_view text);

/// Reads `radius:tolerance,...`, nearest first.
std::vector<Ring> parse_rings(std::string_view option, std::string_view text);

/// A place `x,y` or `x,y,h`, with h as parse_height() reads it. A position that written_position() understands may
/// stand for x,y; it states its CRS itself.
struct Place {
  Point2 position;
  std::optional<double> height;
  std::string crs = {};  ///< the position's CRS; empty: that of the call
};
Place parse_place(std::string_view option, std::string_view text);

/// Returns the value that a library's parse(text) makes from an option's text. An error names the option.
template <class Parse>
auto parsed_by(std::string_view option, const std::string& text, const Parse& parse) {
  try {
    return parse(text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} '{}': {}", option, text, error.what()));
  }
}

/// Whether `text` could be a place; only a hint, to tell it from a file name.
bool may_be_place(std::string_view text);

}  // namespace itin::cli
