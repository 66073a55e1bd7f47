#include "import/empty_import.hpp"

#include <string>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>

namespace itin {

namespace {

std::string filters_of(const ImportOptions& options) {
  if (!options.classes.empty() && !options.where.empty()) return "`classes` and `where` leave";
  if (!options.classes.empty()) return "`classes` leaves";
  return "`where` leaves";
}

/// Says why nothing is left of what was read.
std::string what_became(const ImportReport& report, const ImportOptions& options) {
  std::string text;
  if (report.filtered > 0 && options.classes.empty() && options.where.empty()) {
    text = fmt::format("{} left out as noise (classes 7, 18), unless `classes` asks for these, or as withheld",
                       counted(report.filtered, "point"));
  } else if (report.filtered > 0) {
    text = fmt::format("{} out, or their files withhold, {}", filters_of(options),
                       counted(report.filtered, "point or feature", "points or features"));
  }
  if (report.voids > 0)
    text += fmt::format("{}{} without a height", text.empty() ? "" : ", ",
                        counted(report.voids, "post, point or line", "posts, points or lines"));
  return text.empty() ? "the sources hold no point with a height" : text;
}

}  // namespace

void require_points(ImportReport& report, const ImportOptions& options, bool may_be_void) {
  if (report.read > 0 || report.read_features > 0) return;
  std::string why = what_became(report, options);
  // The warnings tell why heights and places were not taken.
  for (const std::string& warning : report.warnings) why += "; " + warning;
  if (report.filtered > 0 || !may_be_void) throw InputError("nothing to import: " + why);
  report.warnings.push_back("nothing was added: " + why);
}

void require_ground(const ImportReport& report, const ImportOptions& options) {
  if (report.vertices > 0) return;
  throw InputError(
      fmt::format("nothing to import: {} read, but no three of them span ground: they lie on one line, too far "
                  "apart, or nearer to each other than `resolution`{}",
                  report.read == 1 ? "1 point was" : fmt::format("{} points were", report.read),
                  options.max_gap > 0 ? "; give a larger `max_gap`" : ""),
      "resolution");
}

}  // namespace itin
