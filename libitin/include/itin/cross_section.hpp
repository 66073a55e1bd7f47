// Cross-sections: where a straight line crosses the edges of the surface's triangles.
//
//   const CrossSection section = cross_section(store, {305000, 210000}, {315000, 213000}, Detail::tolerance(0));
//   for (const Breakpoint& p : section.breakpoints) std::cout << p.distance << ' ' << p.position.z << '\n';
//
// To have houses stand in the way, pass ThemeChoice::parse("buildings") as the last argument.
//
// The breakpoints are the crossings that a window query's triangles would give, neither more nor fewer, and nothing is
// sampled: between two of them the surface is straight. cross_section() reads the fewest points (R. Smith and others,
// "Implicit triangulations", 1992): it locates the start and crosses each edge into the one triangle behind it. Many
// lines over one area are faster on a SectionSurface, which gives the same breakpoints to the last bit.
//
// A wall is as steep as the store has it. Its foot and its eaves are two breakpoints a hand's breadth apart, or at the
// same distance where the line runs along the wall.
//
// Ends are rounded to 2^-20 grid units (10 nm on a grid of 1 cm), so that every decision is exact; distances to
// multiples of 2^-30 m, so that length - distance is exact and a line from b to a is the mirror of one from a to b.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <itin/detail.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>

namespace itin {

class Store;

struct Breakpoint {
  double distance = 0;  ///< metres along the line
  Point3 position;      ///< on the surface
  /// The number (from 1) in StoreMetadata::themes of the feature that holds the place inside its outline; 0: ground.
  /// Between two breakpoints the surface is part of a feature if either of the two is in it.
  std::uint16_t theme = 0;
};

/// A part of the line without ground, metres along the line. Its ends belong to the ground beside it, if there is any.
struct SectionGap {
  double from = 0;
  double to = 0;
  friend bool operator==(const SectionGap&, const SectionGap&) = default;
};

struct CrossSection {
  double length = 0;       ///< metres
  bool one_place = false;  ///< the ends are less than a step of the store's grid apart
  /// The breakpoints in order of distance. Over ground, the first and the last are the line's ends. Two breakpoints
  /// with no gap between them are joined by a straight piece of the surface. A line of length 0 has one breakpoint.
  /// Where the line merely touches the ground, there is one breakpoint between two gaps.
  std::vector<Breakpoint> breakpoints;
  std::vector<SectionGap> gaps;  ///< in order
  RetrievalStatistics statistics;
  std::uint64_t triangles = 0;  ///< crossed by the line
};

/// Returns where the line crosses the surface's edges. Cost: about a microsecond per triangle crossed when warm; memory
/// follows the line. Throws InputError for ends that are not finite or farther than 2^31 grid units from the grid's
/// origin and for themes that the store does not have, CorruptStore, FileError, Cancelled.
CrossSection cross_section(const Store& store, Point2 from, Point2 to, const Detail& detail,
                           const ThemeChoice& themes = ThemeChoice::none(), const Progress& progress = NoProgress());

/// Returns the triangles that a path meets, if only at a corner: those triangles of a window query over which the
/// cross-sections of the path's legs run. Memory follows the path. Throws InputError for fewer than two places, and
/// what cross_section() and triangulate() throw.
Tin triangles_along(const Store& store, const std::vector<Point2>& path, const Detail& detail,
                    const ThemeChoice& themes, Progress& progress);

/// Answers many cross-sections over one area. Reads squares of ground once, as posts where the ground is a lattice and
/// as triangulated tiles elsewhere, keeps the squares used last, and walks lines through them. Safe for concurrent use.
/// Refers to the Store, which must outlive it.
class SectionSurface {
 public:
  // Options change the speed, never the answer.
  struct Options {
    std::uint64_t cache_bytes = std::uint64_t{256} << 20;
  };

  /// Throws InputError for themes that the store does not have.
  SectionSurface(const Store& store, const Detail& detail, const ThemeChoice& themes = ThemeChoice::none());
  SectionSurface(const Store& store, const Detail& detail, const ThemeChoice& themes, const Options& options);
  SectionSurface(const Store&& store, const Detail& detail, const ThemeChoice& themes = ThemeChoice::none()) = delete;
  SectionSurface(const Store&& store, const Detail& detail, const ThemeChoice& themes, const Options& options) = delete;
  SectionSurface(SectionSurface&&) noexcept;
  SectionSurface& operator=(SectionSurface&&) noexcept;
  ~SectionSurface();

  /// Returns the cross-section; its statistics count what this call read and triangulated. Throws as cross_section()
  /// does.
  CrossSection between(Point2 from, Point2 to) const;

  /// Tells whether the ground about a place is read as posts of a lattice, which takes a twentieth of the time of a
  /// triangulated tile. This changes the speed, never the answer.
  bool is_lattice_at(Point2 place) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin
