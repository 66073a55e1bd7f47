// How sites are surveyed within a memory limit: the stages, from coarse to exact, and the groups of sites in each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/site_coverage.hpp>

#include "plan/effort.hpp"

namespace itin::viewshed {

/// The surface over which a stage judges.
struct StageSurface {
  enum class Kind : std::uint8_t {
    kBareLevel,  ///< the bare terrain of a level
    kThemed,     ///< the full surface with the themes
    kBins        ///< bins of the full surface with the themes
  };
  Kind kind = Kind::kBareLevel;
  int level = 0;  ///< the bare terrain's; 0 with the themes

  bool themed() const { return kind != Kind::kBareLevel; }
  bool binned() const { return kind == Kind::kBins; }
  bool operator==(const StageSurface&) const = default;
};

/// Sites that are judged over one surface.
struct SiteGroup {
  std::vector<std::size_t> options;
  std::uint64_t points = 0;  ///< about as many as that surface has
};

class SurveyStages {
 public:
  /// Store and survey must outlive it. Throws InputError where the bounds on what the sites serve take too much of the
  /// memory.
  SurveyStages(const Store& store, const SiteSurvey& survey);

  /// Tells whether raised features count.
  bool themed() const { return themed_; }
  bool casts_rays() const { return survey_.engine == Engine::kRays; }
  /// Tells whether cells are judged exactly: over the full surface at its own level. Everything else is judged over
  /// envelopes.
  bool judges_cells_exactly(int level) const { return level == 0 && survey_.targets.grid; }
  /// Tells whether Fresnel zones are judged at a level. Over coarse surfaces they take as long as over the full one,
  /// which comes next, if the memory holds it.
  bool judges_zones(int level) const { return survey_.fresnel && (level == 0 || !whole_fits_); }

  /// Returns the bytes for surfaces; the remaining memory is for the rest of the program.
  std::uint64_t memory() const { return (survey_.memory_bytes - sets_) / 4 * 3; }
  /// Returns the bytes that the bounds of all sites take.
  std::uint64_t sets() const { return sets_; }
  /// Tells whether the memory holds the full surface about all sites as triangles.
  bool whole_fits_as_triangles() const;

  /// Chooses the stages. `whole_fits`: the memory holds the full surface about all sites, in whatever form.
  void choose(bool whole_fits);
  bool whole_fits() const { return whole_fits_; }
  int last_stage() const { return static_cast<int>(stages_.size()) - 1; }
  const StageSurface& at(int stage) const { return stages_[static_cast<std::size_t>(stage)]; }
  /// Returns the stage in words: "tolerance 4 m", "exact", ...
  std::string name(int stage) const;

  /// Divides the options into groups of neighbours, each as large as the memory holds.
  std::vector<SiteGroup> groups(std::vector<std::size_t> options, const StageSurface& surface) const;
  /// About how long it takes to judge a group over this surface.
  Effort effort_of(const SiteGroup& group, const StageSurface& surface) const;

 private:
  using Options = std::span<std::size_t>;

  bool fits(std::uint64_t points, std::size_t options, int level) const;
  std::uint64_t points_of(Options options, int level) const;

  const Store& store_;
  const SiteSurvey& survey_;
  const bool themed_;
  const std::uint64_t sets_;
  const Box reach_;             ///< the box within which any site may serve
  const std::uint64_t points_;  ///< the number of the full surface's points within reach_
  const bool cut_;              ///< whether features cut into the full ground somewhere within reach_
  bool whole_fits_ = false;
  std::vector<StageSurface> stages_;
};

}  // namespace itin::viewshed
