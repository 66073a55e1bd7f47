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

}  // namespace

IndexTasks::IndexTasks(const Store& store, const IndexRequest& request, std::uint64_t most_cells, Progress& progress)
    : store_(store),
      request_(request),
      layout_(std::make_unique<const IndexLayout>(lay_out_index(store, request, progress))) {
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

void IndexTasks::add(std::size_t task, std::string_view answer) {
  IndexPart part(cells_of(list_.at(task)));
  ValueReader reader(answer);
  exchange_part(reader, part);
  reader.expect_end();
  for (const auto* values : {&part.shares.share, &part.shares.standard_error, &part.shares.undecided})
    if (values->size() != part.cells.count()) throw NotThoseValues();
  for (const auto* values : {&part.counts.on_ground_of_ray, &part.counts.seen_of_ray})
    if (values->size() != layout_->sample.rays) throw NotThoseValues();
  if (!merge_) merge_ = std::make_unique<IndexMerge>(*layout_);
  merge_->add(part);
}

VisibilityIndex IndexTasks::take() {
  return merge_->take();
}

}  // namespace itin::viewshed
