#include <utility>

#include <itin/byte_archive.hpp>
#include <itin/level_choice.hpp>
#include <viewshed/tasks.hpp>

#include "index/index_part.hpp"
#include "plan/effort.hpp"
#include "plan/partition.hpp"
#include "tasks/task_rectangles.hpp"

namespace itin::viewshed {

namespace {

template <class Archive, class Part>
void exchange_part(Archive& archive, Part& part) {
  auto& c = part.counts;
  archive(part.shares.share, part.shares.standard_error, part.shares.undecided, c.any_eye, c.targets, c.lines,
          c.triangles, c.retrieval.points_read, c.retrieval.blocks_read, c.on_ground_of_ray, c.seen_of_ray);
}

/// Returns about how long it takes to look from the cells of a task over its points.
double seconds_of(const Task& task, const IndexLayout& layout) {
  const auto cells = static_cast<double>(task.cells());
  const IndexSample& each = layout.sample;
  return each.rays > 0 ? effort_of_posts(task.points) + effort_of_looks(cells * each.rays * layout.rings)
                       : effort_of_triangles(task.points) + effort_of_lines(cells * each.targets);
}

/// Returns what the answer of a task says. Throws NotThoseValues.
IndexPart part_of_answer(const IndexLayout& layout, const Task& task, std::string_view answer) {
  IndexPart part(cells_of(task));
  ValueReader reader(answer);
  exchange_part(reader, part);
  reader.expect_end();
  for (const auto* values : {&part.shares.share, &part.shares.standard_error, &part.shares.undecided})
    if (values->size() != part.cells.count()) throw NotThoseValues();
  for (const auto* values : {&part.counts.on_ground_of_ray, &part.counts.seen_of_ray})
    if (values->size() != layout.sample.rays) throw NotThoseValues();
  return part;
}

/// The cells of an index as the answers of its tasks have them.
class IndexOfAnswers final : public IndexParts {
 public:
  IndexOfAnswers(std::shared_ptr<const IndexLayout> layout, std::vector<Task> tasks, AnswerAgain answers)
      : layout_(std::move(layout)), tasks_(std::move(tasks)), answers_(std::move(answers)) {}

  void for_each(const Take& take) const override {
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
      const Task& task = tasks_[i];
      IndexShares shares = part_of_answer(*layout_, task, answers_(i)).shares;
      VisibilityIndex part;
      part.grid = layout_->grid.part(task.north_west, task.columns, task.rows);
      part.share = std::move(shares.share), part.standard_error = std::move(shares.standard_error);
      part.undecided = std::move(shares.undecided);
      take(part, task.north_west);
    }
  }

 private:
  std::shared_ptr<const IndexLayout> layout_;
  std::vector<Task> tasks_;
  AnswerAgain answers_;
};

}  // namespace

IndexTasks::IndexTasks(const Store& store, const IndexRequest& request, std::uint64_t most_cells, Progress& progress)
    : store_(store),
      request_(request),
      layout_(std::make_shared<const IndexLayout>(lay_out_index(store, request, progress))) {
  const RasterGrid& grid = layout_->grid;
  const int level = level_within(store.metadata(), request.detail.coarsest());
  const auto rectangles = parts_that_fit(
      all_cells(grid), [&](const CellRectangle& cells) { return cells.count() <= most_cells || cells.count() == 1; },
      [](const CellRectangle& cells) { return halves(cells); });
  for (const CellRectangle& cells : rectangles) {
    const Box observers = grid.part({cells.column, cells.row}, cells.columns, cells.rows).bounds();
    if (!request.area.is_all() && !request.area.bounds().meets(observers)) continue;
    const double reach = request.radius;
    Task task = task_of(cells);
    task.eyes = cells.count();
    task.points = store.points_about(
        level, {observers.xmin - reach, observers.ymin - reach, observers.xmax + reach, observers.ymax + reach});
    task.seconds = seconds_of(task, *layout_);
    list_.push_back(task);
  }
}
IndexTasks::~IndexTasks() = default;

std::string IndexTasks::answer(std::size_t task, Progress& progress) const {
  ValueWriter writer;
  const IndexPart part = index_part(store_, request_, *layout_, cells_of(list_.at(task)), progress);
  exchange_part(writer, part);
  return writer.bytes();
}

void IndexTasks::read_again_by(const AnswerAgain& answers) {
  answers_ = answers;
}

void IndexTasks::add(std::size_t task, std::string_view answer) {
  if (!merge_)
    merge_ = std::make_unique<IndexMerge>(*layout_, answers_ ? IndexMerge::Cells::kLeftOut : IndexMerge::Cells::kKept);
  merge_->add(part_of_answer(*layout_, list_.at(task), answer));
}

VisibilityIndex IndexTasks::take() {
  VisibilityIndex index = merge_->take();
  if (answers_) index.parts = std::make_shared<IndexOfAnswers>(layout_, list_, answers_);
  return index;
}

}  // namespace itin::viewshed
