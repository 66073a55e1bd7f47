// Options about features on the surface and gaps in it, as far as this version knows any.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace itin::cli {

/// `--themes`: this version's stores hold terrain only, so `none` is all there is to choose.
class ThemeOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate() const;

 private:
  std::string themes_ = "none";
};

}  // namespace itin::cli
