// How probable it is that a sight line is clear where heights are uncertain.
//
//   const VisibilityProbability odds(std::make_shared<const HeightPyramid>(tin), earth, {2.0, 0});
//   VisibilityProbability::Scratch scratch(odds);  // for many lines
//   odds.of_line({eye, target}, scratch).probability
//
// Model. The height of every vertex has a normal error of standard deviation sigma. The errors of two vertices x metres
// apart have the correlation exp(-x / L), none for L = 0. Between vertices errors are, as heights are, linear over each
// triangle. Ends of a line that stand on the surface move with it; ends at a given elevation do not.
//
// Method. The probability is the share of realisations (error_realisations.hpp) in which the line passes above every
// edge that it crosses; errors are drawn along the line (errors_along_line.hpp). So the probability is joint: that of
// the whole line, not of its worst place. The Earth's bulge within a single triangle is left out.
//
// Accuracy. The share's standard error is at most 0.022, that of independent draws; the same realisations serve all
// lines, so that neighbours err alike.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <itin/earth.hpp>
#include <itin/tin.hpp>
#include <viewshed/request.hpp>

#include "bounds/height_pyramid.hpp"
#include "modes/lines/error_realisations.hpp"
#include "modes/lines/errors_along_line.hpp"

namespace itin::viewshed {

/// Safe for concurrent use.
class VisibilityProbability {
 public:
  /// The surface is a Tin. Takes 1 MB.
  VisibilityProbability(std::shared_ptr<const HeightPyramid> surface, const Earth& earth, const VerticalError& error);

  /// The ends of a line, grid units; they differ horizontally.
  struct Line {
    Point3 from, to;
    bool from_stands = true, to_stands = true;  ///< on the surface, and moves with it
  };
  struct Odds {
    double probability = 0;
    bool clear = false;  ///< no ground is in the way, as the heights are
  };
  class Scratch;
  /// Computes the odds of a line. Cost: about half a microsecond per edge that comes near the line, 20 microseconds per
  /// line over rolling ground.
  Odds of_line(const Line& line, Scratch& scratch) const;

 private:
  /// Distances in standard deviations: ground farther below a line hides it in no realisation, and ground that rises
  /// farther above it hides it in all realisations, except for at most one.
  static constexpr double kSure = 4, kHidden = 3.1;
  static constexpr std::size_t kCrossingsPerCount = 8;

  /// A place where a line crosses an edge, or passes over a vertex, which is then both ends of the edge.
  struct Crossing {
    double at = 0;    ///< fraction of the line's length
    double rise = 0;  ///< above the line, grid units
    std::uint32_t a = 0, b = 0;
    double weight_b = 0;
    friend auto operator<=>(const Crossing&, const Crossing&) = default;
  };
  /// The ground under an end.
  struct Footing {
    ErrorSum error;
    double above = 0;  ///< how far the end is above the ground, grid units
  };
  using Margins = std::array<float, ErrorRealisations::kCount>;  ///< how far a line is clear, in sigmas

  bool cross(const Line& line, Scratch& scratch) const;
  Footing under(const Point3& end) const;
  static double share_seen(const Margins& least);
  void narrow(Margins& least, double above, const ErrorsAlongLine::Errors& ground) const;
  void narrow(Margins& least, const Line& line, const Crossing& c, ErrorsAlongLine& errors) const;

  std::shared_ptr<const HeightPyramid> surface_;
  double drop_;         ///< grid units of drop per squared grid unit
  double grazing_;      ///< grid units
  double sigma_;        ///< grid units
  double correlation_;  ///< L in grid units
  ErrorRealisations realisations_;
};

/// Memory to use again, for one thread; fastest for lines from one eye to neighbours.
class VisibilityProbability::Scratch {
 public:
  /// Serves lines of these odds, which must outlive this object.
  explicit Scratch(const VisibilityProbability& odds)
      : errors_(odds.surface_->tin(), odds.correlation_, odds.realisations_) {}

 private:
  friend class VisibilityProbability;
  std::vector<Crossing> crossings_;
  std::optional<std::uint32_t> highest_;  ///< the last line's highest triangle, often near the next one's
  ErrorsAlongLine errors_;
};

}  // namespace itin::viewshed
