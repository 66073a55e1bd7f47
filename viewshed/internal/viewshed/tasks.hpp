// A large question as tasks: each is answered by itself, in any order, by anyone who has the store; the answers are
// exchanged as bytes and merge to the whole.
//
//   ZoneTasks tasks(store, request, most_cells);
//   for (std::size_t i = 0; i < tasks.list().size(); ++i) tasks.add(i, tasks.answer(i, progress));
//   const Zone zone = tasks.take(progress);          // that of survey_turbines(), to the last bit
//
// The tasks of a question depend on the store, the request and the greatest number of cells alone, and an answer on
// nothing else: whoever gives it gives the same bytes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <viewshed/plan.hpp>
#include <viewshed/turbines.hpp>
#include <viewshed/visibility_index.hpp>

namespace itin::viewshed {

class IndexMerge;
class SegmentMerge;
struct IndexLayout;

/// What a task decides, and about what that takes.
struct Task {
  RasterGrid::Cell north_west;  ///< where its rectangle begins in the whole grid; sites make one row, each a column
  std::int64_t columns = 0, rows = 0;
  std::uint64_t eyes = 0;    ///< observers or sites, or turbines that are looked at from its cells
  double seconds = 0;        ///< about how long it takes one thread
  std::uint64_t points = 0;  ///< points of the surface under its sight lines

  std::uint64_t cells() const { return static_cast<std::uint64_t>(columns * rows); }
};

/// Returns the answer of a task, whenever it is asked.
using AnswerAgain = std::function<std::string(std::size_t task)>;

/// answer() is safe for concurrent use with itself.
class Tasks {
 public:
  Tasks() = default;
  Tasks(const Tasks&) = delete;
  Tasks& operator=(const Tasks&) = delete;
  virtual ~Tasks() = default;

  virtual const std::vector<Task>& list() const = 0;
  /// Answers a task. Throws what the question asked as a whole throws.
  virtual std::string answer(std::size_t task, Progress& progress) const = 0;
  /// Lets the result be without what is large and may be read again from the answers, for as long as the result lives.
  /// To be called before add().
  virtual void read_again_by(const AnswerAgain&) {}
  /// Adds the answer of a task. Throws NotThoseValues for other bytes.
  virtual void add(std::size_t task, std::string_view answer) = 0;
};

/// A viewshed: the tasks are the segments of a Plan.
class ViewshedTasks final : public Tasks {
 public:
  /// The store must outlive it. Throws InputError for a request that is refused whatever the surface.
  ViewshedTasks(const Store& store, const Request& request, const ComputeOptions& options, std::uint64_t most_cells,
                Certainty certainty);
  ~ViewshedTasks() override;

  const std::vector<Task>& list() const override { return list_; }
  std::string answer(std::size_t task, Progress& progress) const override;
  /// The cells are left to Result::parts, but in mode kBlocker, which numbers blockers over all of them.
  void read_again_by(const AnswerAgain& answers) override;
  void add(std::size_t task, std::string_view answer) override;
  /// Returns the whole result. Precondition: all answers were added.
  Result take();

 private:
  const Store& store_;
  std::shared_ptr<const Plan> plan_;
  std::vector<Task> list_;
  AnswerAgain answers_;
  std::unique_ptr<SegmentMerge> merge_;
};

/// A visibility index: the tasks are rectangles of its cells.
class IndexTasks final : public Tasks {
 public:
  /// The store must outlive it. Throws InputError as visibility_index() does.
  IndexTasks(const Store& store, const IndexRequest& request, std::uint64_t most_cells, Progress& progress);
  ~IndexTasks() override;

  const std::vector<Task>& list() const override { return list_; }
  std::string answer(std::size_t task, Progress& progress) const override;
  /// The cells are left to VisibilityIndex::parts.
  void read_again_by(const AnswerAgain& answers) override;
  void add(std::size_t task, std::string_view answer) override;
  /// Returns the whole index. Precondition: all answers were added. Throws InputError where there is no ground.
  VisibilityIndex take();

 private:
  const Store& store_;
  IndexRequest request_;
  std::shared_ptr<const IndexLayout> layout_;
  std::vector<Task> list_;
  AnswerAgain answers_;
  std::unique_ptr<IndexMerge> merge_;
};

/// A zone of turbines: the tasks are rectangles of its cells, each with the turbines that are near enough.
class ZoneTasks final : public Tasks {
 public:
  /// The store must outlive it. Throws InputError as survey_turbines() does.
  ZoneTasks(const Store& store, const ZoneRequest& request, std::uint64_t most_cells, Progress& progress);
  ~ZoneTasks() override;

  const std::vector<Task>& list() const override { return list_; }
  std::string answer(std::size_t task, Progress& progress) const override;
  void read_again_by(const AnswerAgain& answers) override;
  void add(std::size_t task, std::string_view answer) override;
  /// Returns the whole zone. Precondition: all answers were added.
  Zone take();

 private:
  ZoneRequest request_of(std::size_t task) const;
  /// Makes room for what is seen.
  void prepare();

  const Store& store_;
  std::unique_ptr<Zone> zone_;  ///< laid out; with room for what is seen once an answer is added
  std::vector<Task> list_;
};

}  // namespace itin::viewshed
