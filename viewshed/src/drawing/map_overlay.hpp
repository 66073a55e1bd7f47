// The colours that a map lays over the ground for each mode, and the legend that explains them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/raster.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/result.hpp>

namespace itin::viewshed {

/// Colours from the palette of Okabe and Ito, which can be told apart with every kind of colour blindness. Visible is
/// also darker than hidden, for grey print.
inline constexpr Rgba kSeenColour{0, 114, 178};
inline constexpr Rgba kUndecidedColour{230, 159, 0};
inline constexpr Rgba kZoneCutColour{204, 121, 167};

struct Tint {
  Rgba colour = kSeenColour;
  double opacity = 0;
};

class MapOverlay {
 public:
  MapOverlay(const Result& result, const MapOptions& options);

  /// The colour of a cell; nothing outside the field of view.
  std::optional<Tint> at(std::size_t cell) const;

  /// Classes of the legend: what a patch of colours stands for.
  struct Key {
    std::vector<Tint> tints;  ///< side by side; none: bare ground
    std::string text;         ///< with the class's area and its share
  };
  const std::vector<Key>& keys() const { return keys_; }

  /// The steps of a scale; none where a mode has no more to tell than the keys.
  struct Step {
    Tint tint;
    std::string text;
  };
  const std::string& scale_title() const { return title_; }
  const std::vector<Step>& scale() const { return steps_; }

 private:
  /// The value that the scale shows; NaN where it shows none.
  double value(std::size_t cell) const;
  bool is_buried(std::size_t cell) const;
  std::optional<std::size_t> step_of(std::size_t cell) const;
  std::vector<Tint> tints_of(Verdict verdict) const;
  void make_scale(const MapOptions& options);
  void scale_counts(const std::string& title);
  void scale_angles();
  void scale_observers();
  void scale_distances();
  void scale_blockers();
  void scale_heights();
  void scale_probabilities();
  void scale_losses();
  void scale_levels();
  double blocker_value(std::uint32_t theme) const;
  void add_step(double most, Tint tint, std::string text);
  void add_key(std::vector<Tint> tints, const std::string& what, std::uint64_t cells);
  void add_key(std::vector<Tint> tints, const std::string& what, std::uint64_t cells, const MapOptions& options,
               double ClassShares::*share);
  std::string area_of(std::uint64_t cells) const;
  void make_keys(const MapOptions& options);
  void add_margin_keys();
  void add_verdict_keys(const MapOptions& options);

  const Result& result_;
  std::string title_;
  std::vector<double> most_;             ///< the greatest value of each step, ascending
  std::vector<std::uint32_t> blockers_;  ///< themes that hide, ascending
  std::vector<Step> steps_;
  bool lacks_values_ = false;  ///< whether a cell in view has no value, where every other has one
  std::vector<Key> keys_;
};

}  // namespace itin::viewshed
