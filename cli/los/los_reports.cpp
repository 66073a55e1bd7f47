#include "los/los_reports.hpp"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>

#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/file_name.hpp>
#include <itin/parallel.hpp>
#include <profile/los.hpp>

#include "output/file_names.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/field_names.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

/// Stands for a link's id in names of files.
constexpr std::string_view kId = "{id}";

struct Written {
  std::vector<std::string> paths;
  std::string failure;  ///< why the first report that failed could not be written
};

/// Names the first of many failures, and the number of further ones.
std::string failure_of(const std::vector<Written>& all) {
  std::size_t failed = 0;
  std::string first;
  for (const Written& one : all) {
    if (one.failure.empty()) continue;
    if (failed++ == 0) first = one.failure;
  }
  if (failed < 2) return first;
  return fmt::format("{}; the reports of {} of {} could not be written", first, failed, counted(all.size(), "link"));
}

}  // namespace

LosReports::~LosReports() {
  while (!folders_.empty()) folders_.pop_back();
}

void LosReports::declare(CLI::App& app) {
  begin_group(app, "Reports");
  writes(app.add_option("--report", paths_,
                        "Write the report, as its ending says: .json .csv .txt .svg .pdf .png .html .kml .gpkg; may be "
                        "given again. The .txt is the profile for other programs: distance km, ground m, height of "
                        "what stands there m, its kind (T vegetation, B anything else, N nothing). With --links one "
                        "for each: {id} in the name stands for the link's")
             ->type_name("FILE")
             ->expected(1)
             ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
  app.add_option("--title", title_, "The report's title")->type_name("TEXT");
  app.add_option("--table-spacing", table_spacing_text_,
                 "Distance between rows of the profile that PDF and HTML reports print; the ends, the critical point, "
                 "obstructions, edges and the reflection point have rows besides; none leaves the profile out "
                 "(default: about 30 rows)")
      ->type_name("METRES|none");
}

void LosReports::validate(bool has_positions) {
  if (!table_spacing_text_.empty() && paths_.empty()) throw InputError("--table-spacing works only with --report");
  if (table_spacing_text_ == "none") {
    table_spacing_m_ = 0;
  } else if (!table_spacing_text_.empty()) {
    table_spacing_m_ = parse_number("--table-spacing", table_spacing_text_, Range::kPositive);
  }
  for (const std::string& path : paths_) profile::require_report_format(path, has_positions);
}

void LosReports::validate_links() {
  validate(true);
  for (const std::string& path : paths_) {
    if (path.find(kId) != std::string::npos) continue;
    throw InputError(
        fmt::format("--report '{}': with --links give each link a file of its own, such as reports/{}.pdf", path, kId));
  }
}

std::string LosReports::title(const std::string& of) const {
  std::string title = title_.empty() ? "Line-of-sight report" : title_;
  if (!of.empty()) title += ": " + of;
  // Line ends and other control characters have no glyphs.
  std::replace_if(
      title.begin(), title.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return title;
}

void LosReports::write(const LosCase& one, const Document& command, const std::vector<std::string>& paths,
                       bool overwrite) const {
  Document whole{{"itin", ITIN_VERSION}, {"command", command}};
  whole.update(one.result.document);
  whole["warnings"] = one.result.warnings;
  const std::string json = json_text(whole, 2) + "\n";
  for (const std::string& path : paths) profile::require_report(one.report, path);
  for (const std::string& path : paths) profile::write_report(one.report, json, path, overwrite);
}

void LosReports::make_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  if (folder.empty() || std::filesystem::is_directory(folder)) return;
  make_folder_of(folder);
  folders_.emplace_back(folder.string());
}

std::vector<LosReports::Job> LosReports::jobs(const std::vector<profile::Link>& links, OutputPolicy& policy) {
  std::vector<Job> jobs;
  FileNames names;
  for (std::size_t i = 0; i < links.size() && given(); ++i) {
    Job& job = jobs.emplace_back(Job{i, {}});
    for (std::string path : paths_) {
      path.replace(path.find(kId), kId.size(), file_name(links[i].id));
      if (!names.insert(path))
        throw InputError(fmt::format(
            "--report: two links' reports would be {}, where upper and lower case are one; give links different ids",
            path));
      make_folder_of(path);
      policy.claim(path);
      job.paths.push_back(std::move(path));
    }
  }
  return jobs;
}

void LosReports::write_all(const std::vector<Job>& jobs, const std::function<LosCase(std::size_t link)>& work,
                           const Document& command, bool overwrite, Progress& progress, Result& result) const {
  std::vector<Written> all(jobs.size());
  std::atomic<std::size_t> done = 0;
  parallel_for(jobs.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    try {
      const LosCase one = work(jobs[i].link);
      for (const std::string& path : jobs[i].paths) {
        write(one, command, {path}, overwrite);
        all[i].paths.push_back(path);
      }
    } catch (const CorruptStore&) {
      throw;
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      all[i].failure = in_options(error.what());
    }
    progress.report("reports", static_cast<double>(++done) / static_cast<double>(jobs.size()));
  });
  for (const Written& one : all) {
    for (const std::string& path : one.paths) result.document["outputs"].push_back(path);
  }
  const std::string failure = failure_of(all);
  if (failure.empty()) return;
  result.failure += (result.failure.empty() ? "" : "; ") + failure;
}

}  // namespace itin::cli
