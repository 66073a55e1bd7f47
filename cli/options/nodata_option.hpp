// `--nodata unknown|block|clear`: what ground without data does to sight lines.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <itin/earth.hpp>

namespace itin::cli {

/// The help of verbs that cannot leave a line undecided.
inline constexpr const char* kPassesIfUnknown =
    "What ground without data does to a sight line: unknown (default) lets it pass, with a warning; block hides the "
    "target, clear lets it pass";

class NoDataOption {
 public:
  void declare(CLI::App& app);
  /// Declares the option with a help of its own, which says the default.
  void declare(CLI::App& app, const std::string& help);
  /// Throws InputError.
  NoData rule() const;
  const std::string& text() const { return text_; }

 private:
  std::string text_ = "unknown";
};

}  // namespace itin::cli
