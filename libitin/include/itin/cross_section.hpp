// Cross-sections: where a straight line crosses the edges of the surface's triangles.
//
//   const CrossSection section = cross_section(store, {305000, 210000}, {315000, 213000}, Detail::tolerance(0));
//   for (const Breakpoint& p : section.breakpoints) std::cout << p.distance << ' ' << p.position.z << '\n';
//
// ThemeChoice::parse("buildings") as a last argument has houses stand in the way.
//
// The breakpoints are the crossings that a window query's triangles would give, neither more nor fewer, and nothing is
// sampled: between two of them the surface is straight. cross_section() reads the fewest points (R. Smith and others,
// "Implicit triangulations", 1992): it locates the start and crosses each edge into the one triangle behind it. Many
// lines over one area are faster on a SectionSurface, which gives the same breakpoints to the last bit.
//
// A wall is as steep as the store has it: its foot and its eaves are two breakpoints a hand's breadth apart, or at one
// distance where the line runs along it.
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
  /// The theme of the feature whose inside, without its outline, holds the place: StoreMetadata::themes[theme - 1]; 0:
  /// ground. Between two breakpoints the surface is part of a feature if it is so at either.
  std::uint16_t theme = 0;
};

/// A part of the line without ground, metres along it. Its ends belong to the ground beside it, if there is any.
struct SectionGap {
  double from = 0;
  double to = 0;
  friend bool operator==(const SectionGap&, const SectionGap&) = default;
};

struct CrossSection {
  double length = 0;       ///< metres
  bool one_place = false;  ///< the ends are nearer to each other than a step of the store's grid
  /// In order of distance. Over ground the first and last are the line's ends; two breakpoints with no gap between them
  /// are joined by a straight piece of the surface. A line of length 0 has one. Where the line merely touches the
  /// ground there is one breakpoint between two gaps.
  std::vector<Breakpoint> breakpoints;
  std::vector<SectionGap> gaps;  ///< in order
  RetrievalStatistics statistics;
  std::uint64_t triangles = 0;  ///< crossed by the line
};

/// Cost: about a microsecond per triangle crossed when warm. Memory follows the line.
/// Throws InputError for ends that are not finite or farther than 2^31 grid units from the grid's origin and for themes
/// that the store does not have, CorruptStore, FileError, Cancelled.
CrossSection cross_section(const Store& store, Point2 from, Point2 to, const Detail& detail,
                           const ThemeChoice& themes = ThemeChoice::none(), const Progress& progress = NoProgress());

/// The triangles that a path meets, be it at a corner: of all that a window query has there, those over which the
/// cross-sections of its legs run. Memory follows the path. Throws InputError for fewer than two places, and as
/// cross_section() and triangulate() do.
Tin triangles_along(const Store& store, const std::vector<Point2>& path, const Detail& detail,
                    const ThemeChoice& themes, Progress& progress);

/// For many lines over one area: reads squares of ground once, as posts where these are a lattice and as triangulated
/// tiles elsewhere, keeps those used last, and walks lines through them. Safe for concurrent use. Refers to the Store,
/// which must outlive it.
class SectionSurface {
 public:
  // Changes the speed, never the answer.
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

  /// Statistics count what this call read and triangulated. Throws as cross_section() does.
  CrossSection between(Point2 from, Point2 to) const;

  /// Whether the ground about a place is read as posts of a lattice, which takes a twentieth of the time that a
  /// triangulated tile takes. Changes the speed, never the answer.
  bool is_lattice_at(Point2 place) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin
