// Maps of where lines of sight run, for reports about them.
#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/sources_in.hpp>
#include <profile/line_classes.hpp>
#include <profile/report_text.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/result_sheet.hpp>

namespace itin::viewshed {

namespace {

using profile::SheetKey;
using profile::SheetSymbol;

constexpr Rgba kOtherColour{105, 105, 105, 255}, kEndColour{20, 60, 140, 255};
constexpr profile::PaperSize kMapPaper = profile::PaperSize::kA4;
constexpr double kLineWidth = 0.6, kOtherWidth = 0.3;

/// A line in parts: its label finds a place at an end of one of them.
profile::SheetLine in_parts(Point2 from, Point2 to, const std::string& label) {
  constexpr int kParts = 24;
  profile::SheetLine line{{}, label, true};
  for (int i = 0; i <= kParts; ++i) {
    const double part = static_cast<double>(i) / kParts;
    line.points.push_back({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)});
  }
  return line;
}

/// The box with a margin about it, no narrower than is good for a map.
Box surroundings(const Box& lines) {
  constexpr double kMargin = 0.15, kLeastMargin = 100, kLeastShape = 0.75;
  const double longer = std::max(lines.width(), lines.height()), margin = std::max(kMargin * longer, kLeastMargin),
               least = kLeastShape * (longer + 2 * margin);
  const double x = std::max(lines.width() / 2 + margin, least / 2),
               y = std::max(lines.height() / 2 + margin, least / 2);
  const Point2 middle{(lines.xmin + lines.xmax) / 2, (lines.ymin + lines.ymax) / 2};
  return {middle.x - x, middle.y - y, middle.x + x, middle.y + y};
}

Box box_about_line(Point2 a, Point2 b) {
  Box box;
  box.extend(a), box.extend(b);
  return box;
}

/// Lines of one look, with their row in the legend.
MapObjects line_objects(std::vector<profile::SheetLine> lines, const Rgba& colour, double width_mm, std::string text) {
  if (lines.empty()) return {};
  return {{profile::SheetLines{std::move(lines), colour, width_mm, false}},
          {{SheetKey::Sample::kLine, {colour}, std::move(text)}}};
}

MapObjects end_objects(std::vector<profile::SheetMark> marks, std::string text) {
  return {{profile::SheetMarks{SheetSymbol::kMast, kEndColour, std::move(marks)}},
          {{SheetKey::Sample::kMark, {kEndColour}, std::move(text), SheetSymbol::kMast}}};
}

/// The ground in the frame of a map that shows this box.
Box ground_about(const Box& shown) {
  profile::MapSheet sheet;
  sheet.paper = kMapPaper, sheet.area = shown;
  return profile::ground_in_frame(sheet);
}

/// Draws the objects, with the buildings of the themes under them.
std::shared_ptr<const profile::MapSheet> drawn(const Store& store, const Box& lines, const ThemeChoice& themes,
                                               std::vector<MapObjects> objects, profile::TitleBlock title,
                                               const std::string& report, Progress& progress) {
  const Box shown = surroundings(lines);
  objects.insert(objects.begin(), building_objects(store, themes, ground_about(shown)));
  std::erase_if(objects, [](const MapObjects& o) { return o.layers.empty(); });
  title.sources = described(sources_in(store, shown, themes), store.metadata());
  const ResultSheet sheet = object_sheet(shown, std::move(objects), std::move(title));
  profile::SheetChoice choice;
  choice.project = report;
  const MapBase base = base_of(store, sheet, kMapPaper, choice, progress);
  return std::make_shared<const profile::MapSheet>(map_sheet(store, sheet, base, kMapPaper, choice));
}

/// The neighbours that a map of this box shows. Their names stand beside them.
MapObjects other_objects(std::span<const profile::Link> others, const Box& line, const Box& shown) {
  std::vector<profile::SheetLine> lines;
  for (const profile::Link& other : others) {
    const Box box = box_about_line(other.from, other.to);
    if (box == line || !box.meets(shown)) continue;
    lines.push_back(in_parts(other.from, other.to, other.id));
  }
  std::string text = "Other links: " + grouped(lines.size());
  return line_objects(std::move(lines), kOtherColour, kOtherWidth, std::move(text));
}

/// The links of a verdict, with their names beside them.
MapObjects links_with_verdict(const profile::LinkSurvey& survey, profile::SightVerdict verdict) {
  std::vector<profile::SheetLine> lines;
  for (std::size_t i = 0; i < survey.results.size(); ++i) {
    const profile::Link& link = survey.table.links[i];
    if (survey.results[i].found && survey.results[i].found->verdict == verdict)
      lines.push_back(in_parts(link.from, link.to, link.id));
  }
  const FeatureClass& looks = profile::class_of(verdict);
  std::string text = fmt::format("{}: {}", looks.text, counted(lines.size(), "link"));
  return line_objects(std::move(lines), looks.colour, kLineWidth, std::move(text));
}

MapObjects failed_links(const profile::LinkSurvey& survey) {
  std::vector<profile::SheetLine> lines;
  for (std::size_t i = 0; i < survey.results.size(); ++i) {
    const profile::Link& link = survey.table.links[i];
    if (!survey.results[i].found) lines.push_back(in_parts(link.from, link.to, link.id));
  }
  std::string text = fmt::format("Could not be computed: {}", counted(lines.size(), "link"));
  return line_objects(std::move(lines), kOtherColour, kOtherWidth, std::move(text));
}

/// The places where links end, once each, with the first name that they have.
MapObjects ends_of(const std::vector<profile::Link>& links) {
  std::vector<profile::SheetMark> marks;
  std::set<std::pair<double, double>> marked;
  const auto mark = [&](Point2 at, const std::string& name) {
    if (marked.insert({at.x, at.y}).second) marks.push_back({at, name});
  };
  for (const bool named : {true, false})
    for (const profile::Link& link : links) {
      if (link.from_name.empty() != named) mark(link.from, link.from_name);
      if (link.to_name.empty() != named) mark(link.to, link.to_name);
    }
  std::string text = counted(marks.size(), "site");
  return end_objects(std::move(marks), std::move(text));
}

}  // namespace

std::shared_ptr<const profile::MapSheet> location_map(const Store& store, const profile::LosReport& report,
                                                      const LocationOptions& options, Progress& progress) {
  const Point2 from = report.from.site->position, to = report.to.site->position;
  const Box line = box_about_line(from, to);
  const FeatureClass& looks = profile::class_of(report.verdict);
  std::vector<MapObjects> objects{other_objects(options.others, line, surroundings(line)),
                                  line_objects({in_parts(from, to, "")}, looks.colour, kLineWidth,
                                               fmt::format("The line of sight: {}", looks.name)),
                                  end_objects({{from, report.from_name}, {to, report.to_name}}, "Its ends")};
  profile::TitleBlock title;
  title.title = "Location";
  title.facts = {{"Length", profile::distance_text(report.profile.length_m, unit_of(report))}};
  return drawn(store, line, options.themes, std::move(objects), std::move(title), report.title, progress);
}

std::shared_ptr<const profile::MapSheet> links_map(const Store& store, const profile::LinkSurvey& survey,
                                                   const std::string& title, Progress& progress) {
  // Ends that are off the data may be anywhere.
  Box box;
  bool any = false;
  for (std::size_t i = 0; i < survey.results.size(); ++i) {
    if (!survey.results[i].found) continue;
    any = true;
    box.extend(survey.table.links[i].from), box.extend(survey.table.links[i].to);
  }
  if (!any) return nullptr;
  std::vector<MapObjects> objects{failed_links(survey)};
  for (const auto verdict :
       {profile::SightVerdict::kVisible, profile::SightVerdict::kUndecided, profile::SightVerdict::kHidden})
    objects.push_back(links_with_verdict(survey, verdict));
  objects.push_back(ends_of(survey.table.links));
  profile::TitleBlock block;
  block.title = "Map of the links";
  return drawn(store, box, survey.query.themes, std::move(objects), std::move(block), title, progress);
}

}  // namespace itin::viewshed
