// Map sheets: `--sheets`, or `--sheet` and `--paper`; `--sheet-scale`, `--project`, `--date`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <profile/sheet_choice.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class SheetOptions {
 public:
  /// Declares `--sheets`: every map on every paper, or what `what` says.
  void declare(CLI::App& app, const std::string& what =
                                  "Maps on paper, to scale, with title block, legend, grid references and "
                                  "sources, as PDF and PNG on A3, A1 or both (default: none)");
  /// Declares `--sheet` and `--paper`: one map in a file of its own.
  void declare_file(CLI::App& app);
  /// Declares `--project` and `--date` alone, for a map that is made unasked.
  void declare_names(CLI::App& app);
  /// Throws InputError. `names_unasked`: `--project` and `--date` are also those of a map that is made unasked.
  void validate(bool names_unasked = false);
  bool given() const { return !choice_.papers.empty(); }
  Document parameters() const;

  const std::string& file() const { return file_; }
  const std::vector<profile::PaperSize>& papers() const { return choice_.papers; }
  const profile::SheetChoice& choice() const { return choice_; }

 private:
  void declare_title_block(CLI::App& app);
  void add_names(CLI::App& app);

  std::string file_, papers_option_, papers_text_, scale_text_;
  profile::SheetChoice choice_;
};

}  // namespace itin::cli
