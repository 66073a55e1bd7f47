// `--report` and `--title`: the files of one line of sight, or of each of many.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/new_folder.hpp>
#include <itin/progress.hpp>
#include <profile/links.hpp>

#include "los/los_case.hpp"
#include "output/output_path.hpp"
#include "program/verb.hpp"

namespace itin::cli {

class LosReports {
 public:
  LosReports() = default;
  LosReports(const LosReports&) = delete;
  LosReports& operator=(const LosReports&) = delete;
  ~LosReports();
  void declare(CLI::App& app);
  bool given() const { return !paths_.empty(); }
  const std::vector<std::string>& paths() const { return paths_; }
  /// Checks the options for one line. Throws InputError.
  void validate(bool has_positions);
  /// Checks the options for links, each of which needs a file name of its own. Throws InputError.
  void validate_links();
  /// Whether a report shows a map of where its line runs.
  bool show_location() const { return std::any_of(paths_.begin(), paths_.end(), profile::shows_location); }
  /// The title given, or "Line-of-sight report"; then a colon and `of`, if that is not empty.
  std::string title(const std::string& of = {}) const;
  /// The spacing, in metres, of the rows of the printed profile, as in LosReport.
  const std::optional<double>& table_spacing_m() const { return table_spacing_m_; }

  /// Writes the report. `command` is the verb and its parameters, as documents have them. Throws FileError.
  void write(const LosCase& one, const Document& command, const std::vector<std::string>& paths, bool overwrite) const;

  struct Job {
    std::size_t link;  ///< the link's place among all links
    std::vector<std::string> paths;
  };
  /// Returns one job per link, in order. Makes the folders that their reports lie in: those that stay empty are removed
  /// with this object. Throws InputError where two files would be one, FileError where one cannot be written.
  std::vector<Job> jobs(const std::vector<profile::Link>& links, OutputPolicy& policy);
  /// Writes the reports in parallel and lists them in `result`, in the links' order. A report that cannot be written is
  /// not listed, and becomes the result's failure. Throws CorruptStore, Cancelled.
  void write_all(const std::vector<Job>& jobs, const std::function<LosCase(std::size_t link)>& work,
                 const Document& command, bool overwrite, Progress& progress, Result& result) const;

 private:
  /// Makes the folder that the file lies in, and those around it, where they are missing.
  void make_folder_of(const std::filesystem::path& path);

  std::vector<std::string> paths_;
  std::string title_, table_spacing_text_;
  std::optional<double> table_spacing_m_;
  std::list<NewFolder> folders_;  ///< a folder before those within it
};

}  // namespace itin::cli
