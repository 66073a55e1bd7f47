// `--nodata unknown|block|clear`: what ground without data does to sight lines.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <itin/earth.hpp>

namespace itin::cli {

/// The choices that decide what ground without data leaves undecided.
inline constexpr const char* kDecidesMissingGround = "--nodata block or clear";

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
