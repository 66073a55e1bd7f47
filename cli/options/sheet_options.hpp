// Map sheets: `--sheets`, or `--sheet` and `--paper`; `--sheet-scale`, `--project`, `--date`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <profile/map_sheet.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class SheetOptions {
 public:
  /// Declares `--sheets`: every map on every paper.
  void declare(CLI::App& app);
  /// Declares `--sheet` and `--paper`: one map in a file of its own.
  void declare_file(CLI::App& app);
  /// Throws InputError.
  void validate();
  bool given() const { return !papers_.empty(); }
  Document parameters() const;

  const std::string& file() const { return file_; }
  const std::vector<profile::PaperSize>& papers() const { return papers_; }
  double scale() const { return scale_; }
  const std::string& project() const { return project_; }
  const std::string& date() const { return date_; }
  /// A picture in place of the shaded relief; empty if there is none.
  const std::string& basemap() const { return basemap_; }

 private:
  void declare_title_block(CLI::App& app);

  std::string file_, papers_option_, papers_text_, scale_text_, project_, date_, basemap_;
  std::vector<profile::PaperSize> papers_;
  double scale_ = 0;
};

/// The files of a map on one paper: "sheet-coverage-A3.pdf" and its picture.
std::vector<std::string> sheet_names(const std::string& map, profile::PaperSize paper);

}  // namespace itin::cli
