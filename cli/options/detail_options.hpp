// The level of detail: `--tolerance`, or `--rings` about a centre.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/detail.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class DetailOptions {
 public:
  /// `rings_about` says where rings lie, such as "the observer". If it is empty, the verb refuses rings, and its help
  /// has none.
  void declare(CLI::App& app, const std::string& rings_about);
  /// Throws InputError.
  void validate();
  bool has_rings() const { return !rings_.empty(); }
  /// `centre` is used by rings only.
  Detail detail(Point2 centre) const;
  Document parameters() const;

 private:
  std::string tolerance_text_, rings_text_;
  double tolerance_ = 0;
  std::vector<Ring> rings_;
};

}  // namespace itin::cli
