#include <algorithm>
#include <limits>
#include <utility>

#include <itin/byte_archive.hpp>
#include <itin/error.hpp>
#include <itin/level_choice.hpp>
#include <viewshed/tasks.hpp>

#include "plan/effort.hpp"
#include "plan/point_counts.hpp"
#include "tasks/task_rectangles.hpp"
#include "turbines/zone_parts.hpp"
#include "turbines/zone_request.hpp"

namespace itin::viewshed {

namespace {

/// The grids of floats that answers hold; shares follow from counts.
constexpr ZoneQuantity kAnsweredQuantities[] = {&Visibility::visible_height_m,
                                                &Visibility::vertical_angle_deg,
                                                &Visibility::vertical_angle_sum_deg,
                                                &Visibility::horizontal_angle_deg,
                                                &Visibility::horizontal_from_deg,
                                                &Visibility::horizontal_occupied_deg,
                                                &Visibility::nearest_m};

template <class Archive, class V>
void exchange_visibility(Archive& archive, V& v) {
  archive(v.hub_count, v.tip_count, v.hub_undecided, v.tip_undecided, v.turbines, v.hubs);
  for (const ZoneQuantity quantity : kAnsweredQuantities) archive(v.*quantity);
}

template <class Archive, class Z>
void exchange_zone(Archive& archive, Z& zone) {
  exchange_visibility(archive, zone.bare);
  if (zone.screened) exchange_visibility(archive, *zone.screened);
  if (zone.seasons) {
    for (auto* counts : {&zone.seasons->summer, &zone.seasons->winter}) archive(counts->hub_count, counts->tip_count);
  }
  if (zone.radar) {
    auto& radar = *zone.radar;
    archive(radar.ground_m, radar.height_m, radar.turbine_m, radar.undecided_height_m, radar.undecided_turbine_m);
  }
  auto& s = zone.statistics;
  archive(s.retrieval.points_read, s.retrieval.blocks_read, s.triangles, s.lines);
}

/// Copies the values of a rectangle's cells into grids of the whole. There may be several grids, one after the other,
/// and fewer of the part than of the whole. Where the part has none, the whole keeps what it has.
class Copies {
 public:
  Copies(const CellRectangle& cells, const RasterGrid& whole) : cells_(cells), whole_(whole) {}

  template <class T>
  void operator()(const std::vector<T>& from, std::vector<T>& to) const {
    const std::size_t count = cells_.count(), all = whole_.cell_count();
    if (from.size() % count != 0 || from.size() / count > to.size() / all) throw NotThoseValues();
    for (std::size_t i = 0; i < from.size(); ++i) to[i / count * all + whole_.index(cells_.cell(i % count))] = from[i];
  }
  void operator()(const Visibility& from, Visibility& to) const {
    const Copies& copy = *this;
    copy(from.hub_count, to.hub_count), copy(from.tip_count, to.tip_count);
    if (!to.turbines.empty()) copy(from.turbines, to.turbines);
    if (!to.hubs.empty()) copy(from.hubs, to.hubs);
    for (const ZoneQuantity quantity : kAnsweredQuantities)
      if (!(to.*quantity).empty()) copy(from.*quantity, to.*quantity);
    undecided(from.tip_count, from.hub_undecided, to.hub_undecided);
    undecided(from.tip_count, from.tip_undecided, to.tip_undecided);
  }

 private:
  /// Nothing is undecided in a part whose lines cross no ground without data.
  void undecided(const std::vector<std::uint16_t>& counts, std::vector<std::uint16_t> from,
                 std::vector<std::uint16_t>& to) const {
    if (to.empty()) return;
    if (from.empty()) {
      from = counts;
      for (std::uint16_t& n : from) n = n == kCountOutside ? n : 0;
    }
    (*this)(from, to);
  }

  CellRectangle cells_;
  const RasterGrid& whole_;
};

/// Returns the zone of a task's cells, with room for what the whole has. Throws NotThoseValues.
Zone zone_of_answer(const Zone& whole, std::string_view answer) {
  Zone part;
  if (whole.screened) part.screened.emplace();
  if (whole.seasons) part.seasons.emplace();
  if (whole.radar) part.radar.emplace();
  ValueReader reader(answer);
  exchange_zone(reader, part);
  reader.expect_end();
  return part;
}

void complete_shares(Visibility& v, std::size_t turbines) {
  for (std::size_t i = 0; i < v.share.size(); ++i)
    if (v.tip_count[i] != kCountOutside) v.share[i] = share_of_turbines(v.tip_count[i], turbines);
}

/// Completes what a part's answer leaves out: words of turbines that nobody sees there, and shares.
void complete_part(const Zone& whole, std::size_t cells, Visibility& v) {
  v.turbines.resize(whole.words * cells);
  if (whole.request.foliage) v.hubs.resize(whole.words * cells);
  v.share.assign(cells, std::numeric_limits<float>::quiet_NaN());
  complete_shares(v, whole.request.turbines.size());
}

/// The cells of a zone as the answers of its tasks have them.
class ZoneOfAnswers final : public ZoneParts {
 public:
  /// All that is in the layout of the whole belongs to the answers; nothing is seen in it yet.
  ZoneOfAnswers(const Zone& layout, std::vector<Task> tasks, AnswerAgain answers)
      : layout_(layout), tasks_(std::move(tasks)), answers_(std::move(answers)) {}

  void for_each(const Take& take) const override {
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
      const Task& task = tasks_[i];
      Zone part = zone_of_answer(layout_, answers_(i));
      part.request = layout_.request;
      part.grid = layout_.grid.part(task.north_west, task.columns, task.rows);
      part.words = layout_.words;
      complete_part(layout_, part.grid.cell_count(), part.bare);
      if (part.screened) complete_part(layout_, part.grid.cell_count(), *part.screened);
      complete_screen(part);
      take(part, task.north_west);
    }
  }

 private:
  Zone layout_;
  std::vector<Task> tasks_;
  AnswerAgain answers_;
};

Box box_of_cells(const RasterGrid& grid, const CellRectangle& cells) {
  return grid.part({cells.column, cells.row}, cells.columns, cells.rows).bounds();
}

bool in_reach(const Turbine& turbine, const Box& cells) {
  return squared_distance(turbine.position, cells) <= turbine.radius * turbine.radius;
}

}  // namespace

ZoneTasks::ZoneTasks(const Store& store, const ZoneRequest& request, std::uint64_t most_cells, Progress& progress)
    : store_(store), zone_(std::make_unique<Zone>(placed_zone(store, request, progress))) {
  if (!request.weights.empty()) throw InputError("sums with weights are of the whole zone", "weights");
  const PointCounts points(store, level_within(store.metadata(), request.detail.coarsest()),
                           window_of(zone_->request).bounds());
  for (const CellRectangle& cells : task_rectangles(zone_->grid, most_cells)) {
    const Box box = box_of_cells(zone_->grid, cells);
    const auto reached = turbines_of_study_area(zone_->request);
    if (!zone_->request.radar &&
        std::none_of(reached.begin(), reached.end(), [&](const Turbine& t) { return in_reach(t, box); }))
      continue;
    list_.push_back(task_of(cells));
    Task& task = list_.back();
    const ZoneRequest of_task = request_of(list_.size() - 1);
    task.eyes = of_task.turbines.size();
    task.points = points.within(window_of(of_task));
    const double lines = static_cast<double>(task.cells() * task.eyes) / 2;  // half of them are open, on average
    task.seconds = (zone_->screened ? 2 : 1) * (effort_of_triangles(task.points) + effort_of_swept_lines(lines));
  }
}
ZoneTasks::~ZoneTasks() = default;

/// The zone of the task's cells alone. Its turbines are those near enough to be seen from there; without any, one that
/// is not. The first task has those that no cell sees, too, for a radar may see them.
ZoneRequest ZoneTasks::request_of(std::size_t task) const {
  const CellRectangle cells = cells_of(list_[task]);
  ZoneRequest request = zone_->request;
  if (!zone_->screened) request.themes.reset();
  request.cell_size.reset();
  request.grid = zone_->grid.part({cells.column, cells.row}, cells.columns, cells.rows);
  const Box box = request.grid->bounds(), all = zone_->grid.bounds();
  const std::vector<Turbine> of_study = turbines_of_study_area(request);
  std::vector<Turbine> near;
  if (std::any_of(of_study.begin(), of_study.end(), [&](const Turbine& t) { return in_reach(t, box); }))
    std::copy_if(request.turbines.begin(), request.turbines.end(), std::back_inserter(near),
                 [&](const Turbine& t) { return in_reach(t, box); });
  else
    near = {of_study.front()};
  if (task == 0)
    std::copy_if(request.turbines.begin(), request.turbines.end(), std::back_inserter(near), [&](const Turbine& t) {
      return !in_reach(t, all) &&
             std::none_of(near.begin(), near.end(), [&](const Turbine& other) { return other.number == t.number; });
    });
  std::sort(near.begin(), near.end(), [](const Turbine& a, const Turbine& b) { return a.number < b.number; });
  request.turbines = std::move(near);
  return request;
}

std::string ZoneTasks::answer(std::size_t task, Progress& progress) const {
  const Zone zone = survey_turbines(store_, request_of(task), progress);
  ValueWriter writer;
  exchange_zone(writer, zone);
  return writer.bytes();
}

void ZoneTasks::read_again_by(const AnswerAgain& answers) {
  Zone layout = *zone_;
  if (layout.request.foliage) layout.seasons.emplace();
  zone_->parts = std::make_shared<ZoneOfAnswers>(layout, list_, answers);
}

void ZoneTasks::add(std::size_t task, std::string_view answer) {
  if (zone_->bare.tip_count.empty()) prepare();
  Zone& whole = *zone_;
  const std::vector<Turbine> turbines = request_of(task).turbines;
  const Zone part = zone_of_answer(whole, answer);
  const Copies copy(cells_of(list_.at(task)), whole.grid);
  copy(part.bare, whole.bare);
  if (whole.screened) copy(*part.screened, *whole.screened);
  if (whole.seasons) {
    for (const auto season : {&Seasons::summer, &Seasons::winter}) {
      copy(((*part.seasons).*season).hub_count, ((*whole.seasons).*season).hub_count);
      copy(((*part.seasons).*season).tip_count, ((*whole.seasons).*season).tip_count);
    }
  }
  whole.statistics += part.statistics;
  if (!whole.radar) return;
  copy(part.radar->height_m, whole.radar->height_m);
  copy(part.radar->undecided_height_m, whole.radar->undecided_height_m);
  whole.radar->ground_m = part.radar->ground_m;
  for (std::size_t i = 0; i < turbines.size(); ++i) {
    std::size_t k = 0;
    while (whole.request.turbines[k].number != turbines[i].number) ++k;
    whole.radar->turbine_m[k] = part.radar->turbine_m.at(i);
    if (!part.radar->undecided_turbine_m.empty())
      whole.radar->undecided_turbine_m.at(k) = part.radar->undecided_turbine_m.at(i);
  }
}

void ZoneTasks::prepare() {
  make_room(*zone_);
  if (!zone_->request.foliage) return;
  const std::vector<std::uint16_t>& outside = zone_->bare.tip_count;
  zone_->seasons = Seasons{{outside, outside}, {outside, outside}};
}

Zone ZoneTasks::take() {
  const std::size_t turbines = zone_->request.turbines.size();
  complete_shares(zone_->bare, turbines);
  if (zone_->screened) complete_shares(*zone_->screened, turbines);
  complete_screen(*zone_);
  return std::move(*zone_);
}

}  // namespace itin::viewshed
