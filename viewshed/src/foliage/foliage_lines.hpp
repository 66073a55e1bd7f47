// The lines of one observer to cells that woods may hide, and what comes through to each.
//
//   const FoliageLines lines(store, {detail, themes, earth}, foliage);
//   const std::vector<LightThrough> light = lines.between(tin, eye, targets, progress);
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <itin/cross_section.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <profile/foliage.hpp>
#include <profile/leaf_areas.hpp>

namespace itin::viewshed {

/// What foliage does to a line.
struct LightThrough {
  double length_m = 0, transmittance = 1;
};

/// Safe for concurrent use.
class FoliageLines {
 public:
  /// The surface that lines run over.
  struct Surface {
    Detail detail;
    ThemeChoice themes;
    Earth earth;
  };
  /// The store must outlive it. Throws InputError as profile::through_foliage() does, CorruptStore.
  FoliageLines(const Store& store, Surface surface, const profile::Foliage& foliage);

  /// Returns what comes through on the lines from an eye to targets, all in metres. `tin` has the surface under the
  /// lines. Where a decision is within rounding, the line is walked as `itin los` walks it. Throws CorruptStore,
  /// Cancelled.
  std::vector<LightThrough> between(const Tin& tin, const Point3& eye, std::span<const Point3> targets,
                                    Progress& progress) const;

  /// Lines from one eye that are asked for one after the other.
  class FromEye;
  /// Prepares them. `tin` must outlive the result, as this object must.
  FromEye from(const Tin& tin, const Point3& eye) const;

 private:
  class Walk;
  std::vector<LightThrough> walked(const Walk& walk, const Point3& eye, std::span<const Point3> targets,
                                   Progress& progress) const;

  Surface surface_;
  profile::LeafAreas leaves_;
  double least_;
  SectionSurface sections_;
};

class FoliageLines::FromEye {
 public:
  ~FromEye();
  /// As between() has it.
  std::vector<LightThrough> to(std::span<const Point3> targets, Progress& progress) const;

 private:
  friend class FoliageLines;
  FromEye(const FoliageLines& lines, const Tin& tin, const Point3& eye);

  const FoliageLines& lines_;
  Point3 eye_;
  std::unique_ptr<const Walk> walk_;
};

}  // namespace itin::viewshed
