// Work that is done over one surface after another, each as large as the memory holds: the one loop over such segments,
// and the progress that they share.
//
//   for_each_segment(parts, effort_of, progress, [&](const Part& part, SegmentProgress& of_part) {
//     const Tin surface = triangulate(store, part.window, detail, of_part.reading(), themes);
//     for_each_step(part.tiles.size(), "sight lines", of_part.judging(), judge);
//   });
#pragma once

#include <itin/call_progress.hpp>
#include <itin/progress.hpp>

#include "plan/effort.hpp"

namespace itin::viewshed {

/// The progress of one segment: of what it reads, then of what it decides.
class SegmentProgress {
 public:
  SegmentProgress(Effort effort, Progress& whole) : effort_(effort), call_(whole) {}

  /// Begins to read `share` of all that the segment reads.
  Progress& reading(double share = 1) {
    const double reading = share * effort_.reading;
    Progress& step = call_.step(effort_.all() > 0 ? reading / effort_.all() : 0);
    effort_.reading -= reading;
    return step;
  }
  /// Begins to decide: all that is left.
  Progress& judging() { return call_.step(1); }

 private:
  Effort effort_;  ///< what is left of it
  CallProgress call_;
};

/// Calls answer(segment, progress of the segment) for each of the segments, in their order. effort_of(segment) tells
/// about how long each takes. Throws Cancelled.
template <class Segments, class EffortOf, class Answer>
void for_each_segment(const Segments& segments, const EffortOf& effort_of, Progress& progress, const Answer& answer) {
  CallProgress call(progress);
  double left = 0;
  for (const auto& segment : segments) left += effort_of(segment).all();
  for (const auto& segment : segments) {
    call.throw_if_cancelled();
    const Effort effort = effort_of(segment);
    SegmentProgress of_segment(effort, call.step(left > 0 ? effort.all() / left : 1));
    answer(segment, of_segment);
    left -= effort.all();
  }
  call.finish();
}

}  // namespace itin::viewshed
