// The region a verb works on, given as exactly one of `--bbox`, `--polygon`, `--disc`, `--wedge`, `--corridor`,
// `--all`.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <itin/store.hpp>
#include <itin/window.hpp>

#include "options/places/in_crs.hpp"
#include "program/verb.hpp"

namespace itin::cli {

class WindowOptions {
 public:
  void declare(CLI::App& app);
  /// Throws InputError.
  void validate();

  struct Region {
    Window window;
    Point2 centre;  ///< for rings: a disc's centre, a wedge's apex, else the middle of the bounds
  };
  /// The region, in the store's CRS. Throws InputError, FileError.
  Region region(const StoreMetadata& metadata) const;
  /// The message for a window that holds no ground: it says where the window lies and where the data does.
  std::string no_ground(const StoreMetadata& metadata) const;
  Document parameters() const;

 private:
  enum class Shape { kBox, kPolygon, kDisc, kWedge, kCorridor, kAll };

  std::string bbox_, polygon_, disc_, wedge_, corridor_;
  bool all_ = false;
  InCrs in_crs_;

  Shape shape_ = Shape::kAll;
  std::vector<double> numbers_;  ///< the values of the shape's option
};

}  // namespace itin::cli
