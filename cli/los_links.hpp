// `itin los --links`: one row a link.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/store.hpp>
#include <profile/links.hpp>
#include <profile/los.hpp>

#include "los_store.hpp"
#include "verb.hpp"

namespace itin::cli {

class LosLinks {
 public:
  void declare(CLI::App& app);
  bool given() const { return !path_.empty(); }
  const std::string& output() const { return output_; }
  /// Throws InputError.
  void validate();
  Document parameters() const;
  /// In the store's CRS. Throws FileError, InputError.
  std::vector<profile::Link> links(const Store& store, const LosStoreOptions& surface) const;
  /// Writes the table. Where a link could not be computed the result says so as its failure. Throws FileError,
  /// InputError, CorruptStore, Cancelled.
  Result run(const Store& store, const std::vector<profile::Link>& links, const LosStoreOptions& surface,
             const profile::LosQuery& query, bool overwrite, Progress& progress) const;

 private:
  std::string path_, output_, height_text_;
  double height_ = 2;
};

}  // namespace itin::cli
