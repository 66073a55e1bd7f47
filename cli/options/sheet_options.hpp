// Map sheets: `--sheets`, `--sheet-scale`, `--project`, `--date`.
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
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  bool given() const { return !papers_.empty(); }
  Document parameters() const;

  const std::vector<profile::PaperSize>& papers() const { return papers_; }
  double scale() const { return scale_; }
  const std::string& project() const { return project_; }
  const std::string& date() const { return date_; }

 private:
  std::string papers_text_, scale_text_, project_, date_;
  std::vector<profile::PaperSize> papers_;
  double scale_ = 0;
};

}  // namespace itin::cli
