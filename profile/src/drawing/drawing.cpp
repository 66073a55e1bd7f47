#include "drawing/drawing.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include <itin/file_ending.hpp>

#include "drawing/surface.hpp"

namespace itin::profile {

namespace {

/// Tells whether a word is the unit of the number that ends the word before it, with punctuation behind: "km²)".
bool is_unit_of(const std::string& number, const std::string& word) {
  constexpr std::array kUnits{"%", "m", "km", "m²", "km²", "dB", "dBi", "dBm", "GHz", "h", "min", "°"};
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::string unit = word.substr(0, word.find_last_not_of(",.;:)") + 1);
  return !number.empty() && is_digit(number.back()) && std::find(kUnits.begin(), kUnits.end(), unit) != kUnits.end();
}

/// Returns the words of a text. A number and its unit are one word.
std::vector<std::string> unbroken_words(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream blanks(text);
  for (std::string word; blanks >> word;) {
    if (!words.empty() && is_unit_of(words.back(), word)) {
      words.back() += " " + word;
    } else {
      words.push_back(word);
    }
  }
  return words;
}

}  // namespace

std::optional<Drawing::Format> Drawing::format_of(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".svg") return Format::kSvg;
  if (ending == ".pdf") return Format::kPdf;
  if (ending == ".png") return Format::kPng;
  return std::nullopt;
}

Drawing::Drawing(Format format, double width, double height, double pixels_per_point)
    : width_(width),
      height_(height),
      surface_(format == Format::kSvg || format == Format::kSvgParts
                   ? svg_surface(format, width, height)
                   : cairo_surface(format, width, height, pixels_per_point)) {}
Drawing::~Drawing() = default;

void Drawing::polyline(std::span<const Point2> points, const Stroke& stroke) {
  surface_->polyline(points, stroke);
}

void Drawing::polygon(std::span<const Point2> points, const Colour& fill) {
  surface_->polygon(points, fill);
}

void Drawing::area(std::span<const std::vector<Point2>> rings, const Colour& fill) {
  surface_->area(rings, fill);
}

void Drawing::rectangle(const Box& box, const Colour& fill) {
  const Point2 corners[] = {{box.xmin, box.ymin}, {box.xmax, box.ymin}, {box.xmax, box.ymax}, {box.xmin, box.ymax}};
  polygon(corners, fill);
}

void Drawing::outline(const Box& box, const Stroke& stroke) {
  polyline(std::array{Point2{box.xmin, box.ymin}, Point2{box.xmax, box.ymin}, Point2{box.xmax, box.ymax},
                      Point2{box.xmin, box.ymax}, Point2{box.xmin, box.ymin}},
           stroke);
}

void Drawing::circle(Point2 centre, double radius, const Colour& fill) {
  surface_->circle(centre, radius, fill);
}

void Drawing::cells(const Box& box, CellCounts counts, std::span<const Rgba> colours) {
  surface_->cells(box, counts, colours);
}

double Drawing::text_width(const std::string& text, const Lettering& lettering) const {
  return surface_->text_width(text, lettering);
}

std::string Drawing::fitted(std::string text, double width, const Lettering& lettering) const {
  if (text_width(text, lettering) <= width) return text;
  const std::string dots = "\xE2\x80\xA6";
  while (!text.empty() && text_width(text + dots, lettering) > width) {
    // Only whole characters of UTF-8 are removed.
    while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
    text.pop_back();
  }
  return text + dots;
}

void Drawing::text(Point2 anchor, const std::string& text, const Lettering& lettering) {
  surface_->text(anchor, text, lettering);
}

std::vector<std::string> Drawing::lines(const std::string& text, double width, const Lettering& lettering) const {
  std::vector<std::string> lines(1);
  for (const std::string& word : unbroken_words(text)) {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (text_width(longer, lettering) <= width) {
      lines.back() = longer;
      continue;
    }
    if (!lines.back().empty()) lines.emplace_back();
    lines.back() = word;
    while (text_width(lines.back(), lettering) > width) {
      const std::size_t end = end_within(lines.back(), width, lettering);
      if (end == lines.back().size()) break;  // a single character is wider than the line
      std::string rest = lines.back().substr(end);
      lines.back().resize(end);
      lines.push_back(std::move(rest));
    }
  }
  return lines;
}

std::size_t Drawing::end_within(const std::string& word, double width, const Lettering& lettering) const {
  const auto next = [&](std::size_t at) {
    do ++at;
    while (at < word.size() && (static_cast<unsigned char>(word[at]) & 0xC0) == 0x80);
    return at;
  };
  std::size_t end = next(0);
  while (end < word.size() && text_width(word.substr(0, next(end)), lettering) <= width) end = next(end);
  return end;
}

Lettering Drawing::lettering_for(const std::string& text, double width, std::size_t most, Lettering lettering) const {
  constexpr double kLeast = 5, kStep = 0.5;
  const auto fits = [&] {
    const std::vector<std::string> words = unbroken_words(text);
    const bool breaks_words = std::any_of(words.begin(), words.end(),
                                          [&](const std::string& word) { return text_width(word, lettering) > width; });
    return !breaks_words && lines(text, width, lettering).size() <= most;
  };
  while (lettering.size > kLeast && !fits()) lettering.size = std::max(kLeast, lettering.size - kStep);
  return lettering;
}

void Drawing::clip(const Box& box) {
  surface_->clip(box);
}

void Drawing::unclip() {
  surface_->unclip();
}

void Drawing::new_page() {
  surface_->new_page();
}

std::string Drawing::finish() {
  return surface_->finish();
}

}  // namespace itin::profile
