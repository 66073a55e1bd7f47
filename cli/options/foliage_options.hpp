// Sight through woods: `--foliage`, `--leaf-area`, `--transmittance`.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <profile/foliage.hpp>

#include "program/verb.hpp"

namespace itin::cli {

class FoliageOptions {
 public:
  void declare(CLI::App& app);
  /// Declares --foliage and --leaf-area, where nothing is seen or hidden.
  void declare_of_paths(CLI::App& app);
  /// Declares --foliage and --transmittance, for answers in leaf and in winter alike.
  void declare_of_seasons(CLI::App& app);
  /// Throws InputError.
  void validate();
  bool given() const { return option_ != nullptr && option_->count() > 0; }
  const profile::Foliage& foliage() const { return foliage_; }
  /// Nothing where light is not to come through woods.
  Document parameters() const;

 private:
  void declare_foliage(CLI::App& app);
  void declare_leaf_area(CLI::App& app);
  void declare_transmittance(CLI::App& app);

  CLI::Option* option_ = nullptr;
  std::string extinction_text_, leaf_area_text_, transmittance_text_;
  profile::Foliage foliage_;
  bool of_seasons_ = false, of_paths_ = false;
};

}  // namespace itin::cli
