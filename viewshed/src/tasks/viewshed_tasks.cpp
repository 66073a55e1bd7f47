#include <viewshed/tasks.hpp>

#include "files/segment_bytes.hpp"
#include "plan/effort.hpp"

namespace itin::viewshed {

ViewshedTasks::ViewshedTasks(const Store& store, const Request& request, const ComputeOptions& options,
                             std::uint64_t most_cells, Certainty certainty)
    : store_(store), plan_(store, request, options, most_cells, certainty) {
  const SurfaceForm form = takes_a_lattice(store, request) ? SurfaceForm::kPosts : SurfaceForm::kTriangles;
  for (std::size_t i = 0; i < plan_.segments().size(); ++i) {
    const Segment& segment = plan_.segments()[i];
    Task& task = list_.emplace_back(Task{segment.north_west, segment.columns, segment.rows});
    task.eyes = segment.observers.size();
    task.points = segment.points;
    task.seconds = effort_of_viewshed(plan_.request_of(i), segment.points, task.cells(), form).all();
  }
}

std::string ViewshedTasks::answer(std::size_t task, Progress& progress) const {
  return segment_bytes(decide(store_, plan_, task, progress));
}

void ViewshedTasks::add(std::size_t task, std::string_view answer) {
  if (!merge_) merge_ = std::make_unique<Merge>(plan_);
  merge_->add(task, segment_result(answer, plan_, task));
}

Result ViewshedTasks::take() {
  return merge_->take();
}

}  // namespace itin::viewshed
