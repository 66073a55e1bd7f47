// `itin los --links`: one row per link.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/store.hpp>
#include <profile/links.hpp>
#include <profile/los.hpp>

#include "los/los_store.hpp"
#include "program/verb.hpp"

namespace itin::cli {

class LosLinks {
 public:
  void declare(CLI::App& app);
  bool given() const { return !path_.empty(); }
  const std::vector<std::string>& outputs() const { return outputs_; }
  /// Whether an output is a .pdf.
  bool writes_pages() const { return std::any_of(outputs_.begin(), outputs_.end(), profile::shows_location); }
  /// Checks the options. `object` is what stands at each second end; its tip is then the height of second ends for
  /// which the file gives none. Throws InputError.
  void validate(const std::optional<profile::TallObject>& object);
  /// Requires, for a call without --links, that no option is given that works only with it. Throws InputError.
  void require_none() const;
  Document parameters() const;
  /// Reads the links, in the store's CRS. Throws FileError, InputError.
  profile::LinkTable table(const Store& store, const LosStoreOptions& surface) const;

  /// The query for every link that does not ask for something else itself.
  static profile::LinkQuery query(const profile::LosQuery& line, const LosStoreOptions& surface);

  /// The result of a survey whose outputs are written. Where a link could not be computed, its failure says so.
  Result result_of(const profile::LinkSurvey& survey) const;

 private:
  std::string path_, height_text_;
  std::vector<std::string> outputs_;
  profile::LinkHeights heights_{2, 2};
  profile::LinkChoice choice_;
};

}  // namespace itin::cli
