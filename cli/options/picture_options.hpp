// The picture of a surface: `--image`, seen obliquely from afar, or with `--eye` from a place.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <itin/detail.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/tin.hpp>
#include <viewshed/map_image.hpp>

namespace itin::cli {

class PictureOptions {
 public:
  /// `of` names what the picture shows: "the surface".
  void declare(CLI::App& app, const std::string& of);
  /// Throws InputError.
  void validate();

  /// The picture's file; empty where no picture is asked for.
  const std::string& path() const { return path_; }
  /// Draws and writes the picture. Throws InputError where the eye has no ground below it, and what write_image()
  /// throws.
  void write(const Store& store, const Tin& tin, const Detail& detail, bool overwrite, Progress& progress) const;

 private:
  viewshed::MapImage draw(const Store& store, const Tin& tin, const Detail& detail, Progress& progress) const;

  std::string path_, look_, eye_text_, field_text_;
  bool edges_ = false;
  viewshed::ObliqueOptions oblique_;
  std::optional<viewshed::PerspectiveOptions> perspective_;  ///< its eye's z is a height above the ground
};

}  // namespace itin::cli
