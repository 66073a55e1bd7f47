#include <utility>

#include <viewshed/tasks.hpp>

#include "files/segment_bytes.hpp"
#include "plan/effort.hpp"
#include "plan/planned_result.hpp"
#include "plans/segment_merge.hpp"

namespace itin::viewshed {

namespace {

/// The cells of a viewshed as the answers of its tasks have them.
class ViewshedOfAnswers final : public ResultParts {
 public:
  ViewshedOfAnswers(std::shared_ptr<const Plan> plan, AnswerAgain answers)
      : plan_(std::move(plan)), answers_(std::move(answers)) {}

  void for_each(const Take& take) const override {
    for (std::size_t i = 0; i < plan_->segments().size(); ++i) {
      const Segment& segment = plan_->segments()[i];
      const Result of_segment = segment_result(answers_(i), *plan_, i);
      Result part;
      part.request = plan_->request();
      part.grid = of_segment.grid;
      add_certainty(*plan_, part);
      SegmentCells cells(part);
      cells.add(segment, of_segment, {0, 0});
      cells.finish();
      part.cells = of_segment.cells;
      take(part, segment.north_west);
    }
  }

 private:
  std::shared_ptr<const Plan> plan_;
  AnswerAgain answers_;
};

}  // namespace

ViewshedTasks::ViewshedTasks(const Store& store, const Request& request, const ComputeOptions& options,
                             std::uint64_t most_cells, Certainty certainty)
    : store_(store), plan_(std::make_shared<const Plan>(store, request, options, most_cells, certainty)) {
  const SurfaceForm form = takes_a_lattice(store, request) ? SurfaceForm::kPosts : SurfaceForm::kTriangles;
  for (std::size_t i = 0; i < plan_->segments().size(); ++i) {
    const Segment& segment = plan_->segments()[i];
    Task& task = list_.emplace_back(Task{segment.north_west, segment.columns, segment.rows});
    task.eyes = segment.observers.size();
    task.points = segment.points;
    task.seconds = effort_of_viewshed(plan_->request_of(i), segment.points, task.cells(), form).all();
  }
}
ViewshedTasks::~ViewshedTasks() = default;

std::string ViewshedTasks::answer(std::size_t task, Progress& progress) const {
  return segment_bytes(decide(store_, *plan_, task, progress));
}

void ViewshedTasks::read_again_by(const AnswerAgain& answers) {
  if (plan_->request().mode != Mode::kBlocker) answers_ = answers;
}

void ViewshedTasks::add(std::size_t task, std::string_view answer) {
  if (!merge_)
    merge_ =
        std::make_unique<SegmentMerge>(*plan_, answers_ ? SegmentMerge::Cells::kLeftOut : SegmentMerge::Cells::kKept);
  merge_->add(task, segment_result(answer, *plan_, task));
}

Result ViewshedTasks::take() {
  Result result = merge_->take();
  if (answers_) result.parts = std::make_shared<ViewshedOfAnswers>(plan_, answers_);
  return result;
}

}  // namespace itin::viewshed
