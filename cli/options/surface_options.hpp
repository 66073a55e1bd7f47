// Options about features on the surface.
//
//   ThemeOptions themes;
//   themes.declare(app);
//   // Once `app` has its values:
//   themes.validate();
//   themes.complete(store, progress);
//   use(themes.choice());
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>

#include "program/verb.hpp"

namespace itin::cli {

/// `--themes all|none|name,name`: everything that was imported counts, unless a call leaves it out. `--without` leaves
/// out single features.
class ThemeOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();
  /// Finds the features of --without in the store. Throws InputError, CorruptStore, FileError, Cancelled.
  void complete(const Store& store, Progress& progress);
  /// The choice, without features only once it is complete.
  const ThemeChoice& choice() const { return choice_; }
  Document parameters() const;

 private:
  std::string themes_ = "all";
  std::vector<std::string> without_texts_, without_;  ///< as given, and each feature by itself
  ThemeChoice choice_ = ThemeChoice::all();
};

}  // namespace itin::cli
