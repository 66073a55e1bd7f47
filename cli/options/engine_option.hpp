// `--engine auto|sweep|rays`: what decides sight lines to cells.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <viewshed/request.hpp>

namespace itin::cli {

class EngineOption {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  viewshed::Engine engine() const;

 private:
  std::string text_ = "auto";
};

}  // namespace itin::cli
