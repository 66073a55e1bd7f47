// How sites are surveyed under a memory: in stages, from coarse to exact, and at each stage which of them together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/site_coverage.hpp>

namespace itin::viewshed {

/// What a stage judges over.
struct StageSurface {
  enum class Kind : std::uint8_t {
    kBareLevel,  ///< the bare terrain of a level
    kThemed,     ///< the full surface with the themes
    kBins        ///< bins of this
  };
  Kind kind = Kind::kBareLevel;
  int level = 0;  ///< the bare terrain's; 0 with the themes

  bool themed() const { return kind != Kind::kBareLevel; }
  bool binned() const { return kind == Kind::kBins; }
};

class SurveyStages {
 public:
  /// Both must outlive it. Throws InputError where what is known of the sites takes too much of the memory.
  SurveyStages(const Store& store, const SiteSurvey& survey);

  /// Whether raised features count.
  bool themed() const { return themed_; }
  bool casts_rays() const { return survey_.engine == Engine::kRays; }
  /// Cells are judged over the full surface at its own level; everything else over envelopes.
  bool judges_cells_exactly(int level) const { return level == 0 && survey_.targets.grid; }
  /// Over coarse surfaces zones take as long as over the full one, which comes next, if the memory holds it.
  bool judges_zones(int level) const { return survey_.fresnel && (level == 0 || !whole_fits_); }

  /// Bytes for surfaces; what is left is for the rest of the program.
  std::uint64_t memory() const { return (survey_.memory_bytes - sets_) / 4 * 3; }
  /// Bytes of what is known of all sites.
  std::uint64_t sets() const { return sets_; }
  /// Whether the memory holds the full surface about all sites as triangles.
  bool whole_fits_as_triangles() const;

  /// Chooses the stages. `whole_fits`: the memory holds the full surface about all sites, in whatever form.
  void choose(bool whole_fits);
  bool whole_fits() const { return whole_fits_; }
  int last_stage() const { return static_cast<int>(stages_.size()) - 1; }
  const StageSurface& at(int stage) const { return stages_[static_cast<std::size_t>(stage)]; }
  /// In words: "tolerance 4 m", "exact", ...
  std::string name(int stage) const;

  /// Neighbours together, as many as the memory holds.
  std::vector<std::vector<std::size_t>> groups(std::vector<std::size_t> options, const StageSurface& surface) const;

 private:
  using Options = std::span<std::size_t>;

  bool fits(std::uint64_t points, std::size_t options, int level) const;
  std::uint64_t points_of(Options options, int level) const;
  std::pair<Options, Options> halves_across(Options options) const;

  const Store& store_;
  const SiteSurvey& survey_;
  const bool themed_;
  const std::uint64_t sets_;
  const Box reach_;             ///< the box within which any site may serve
  const std::uint64_t points_;  ///< how many the full surface has there
  const bool cut_;              ///< features are lower than it somewhere there
  bool whole_fits_ = false;
  std::vector<StageSurface> stages_;
};

}  // namespace itin::viewshed
