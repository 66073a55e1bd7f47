// The surfaces over which groups of sites are judged, read when a stage asks for them.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/surface.hpp>

#include "siting/coverage/group_survey.hpp"
#include "siting/coverage/survey_stages.hpp"

namespace itin::viewshed {

class GroupSurfaces {
 public:
  /// All arguments must outlive it. Readings are counted in `statistics`.
  GroupSurfaces(const Store& store, const SiteSurvey& survey, const SurveyStages& stages, Statistics& statistics);

  /// Tries to read the full surface about all sites as a lattice, which takes little memory. Only reading tells whether
  /// the surface is a lattice.
  bool read_whole_lattice(Progress& progress);

  /// Returns the survey of a group over the surface of a stage, which is kept until another group's is asked for.
  /// Throws as triangulate() does.
  const GroupSurvey& survey_of(const std::vector<std::size_t>& group, const StageSurface& surface, Progress& progress);
  /// Returns the survey over the full surface about all sites, which is kept. Precondition: the memory holds that
  /// surface.
  const GroupSurvey& whole(const StageSurface& surface, Progress& progress);
  /// Frees the surveys that are kept.
  void release();

  /// Returns the request of some sites, over a surface with the themes or without. Without the themes, targets on roofs
  /// are raised above the bare ground so far that they are seen from wherever the real ones may be.
  Request request_of(std::span<const std::size_t> options, bool themed) const;

 private:
  struct OfGroup {
    std::vector<std::size_t> group;
    StageSurface surface;
    std::unique_ptr<GroupSurvey> survey;
  };

  std::unique_ptr<GroupSurvey> read(const std::vector<std::size_t>& group, const StageSurface& surface,
                                    Progress& progress);
  std::unique_ptr<GroupSurvey> binned(Progress& progress);
  std::unique_ptr<GroupSurvey> exact_cells(const std::vector<std::size_t>& group, bool themed, Progress& progress);
  std::unique_ptr<GroupSurvey> enveloped(const std::vector<std::size_t>& group, const StageSurface& surface,
                                         Progress& progress);
  EnvelopeRequest what_to_read(const std::vector<std::size_t>& group, int level) const;

  const Store& store_;
  const SiteSurvey& survey_;
  const SurveyStages& stages_;
  Statistics& statistics_;
  double raise_ = 0;  ///< metres by which targets on features are raised above the bare ground
  std::optional<RetrievedSurface> whole_lattice_;      ///< until a survey takes it
  std::array<std::unique_ptr<GroupSurvey>, 2> whole_;  ///< bare, and with the themes
  std::optional<OfGroup> last_;
};

}  // namespace itin::viewshed
