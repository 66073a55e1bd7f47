// `--nodata unknown|block|clear`: what ground without data does to sight lines.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/earth.hpp>

namespace itin::cli {

class NoDataOption {
 public:
  NoDataOption() = default;
  /// With these choices only, of which `text` is the default.
  NoDataOption(std::vector<std::string_view> choices, std::string text)
      : choices_(std::move(choices)), text_(std::move(text)) {}

  void declare(CLI::App& app);
  /// With a help of its own, which says the default.
  void declare(CLI::App& app, const std::string& help);
  /// Throws InputError.
  NoData rule() const;
  const std::string& text() const { return text_; }

 private:
  std::vector<std::string_view> choices_{"unknown", "block", "clear"};
  std::string text_ = "unknown";
};

}  // namespace itin::cli
