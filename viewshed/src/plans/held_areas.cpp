#include "plans/held_areas.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <itin/error.hpp>
#include <itin/lattice_reader.hpp>
#include <itin/level_choice.hpp>
#include <itin/window.hpp>
#include <viewshed/surface.hpp>

namespace itin::viewshed {

namespace {

/// The whole squares of a fixed grid that a box meets once it is larger by `margin` on every side. `side` is a power of
/// two metres.
Box squares_about(const Box& box, double side, double margin) {
  const auto down = [&](double v) { return std::floor((v - margin) / side) * side; };
  const auto up = [&](double v) { return std::ceil((v + margin) / side) * side; };
  return {down(box.xmin), down(box.ymin), up(box.xmax), up(box.ymax)};
}

/// A side between an eighth and a quarter of the box's longer side.
double side_for(const Box& box) {
  return std::exp2(std::ceil(std::log2(std::max({box.width(), box.height(), 1.0})) - 3));
}

/// About the share of a call's time that reading takes, in calls that read first.
constexpr double kReadingArea = 0.7;

/// Waits for what another thread reads.
template <class T>
T await(const std::shared_future<T>& future, const Progress& progress) {
  constexpr std::chrono::milliseconds kOften(20);
  while (future.wait_for(kOften) != std::future_status::ready) progress.throw_if_cancelled();
  return future.get();
}

}  // namespace

HeldAreas::HeldAreas(const Store& store, const Detail& detail, const ThemeChoice& themes, const ComputeOptions& options)
    : store_(store),
      detail_(detail),
      themes_(themes),
      options_(options),
      is_full_(level_within(store.metadata(), detail.coarsest()) == 0),
      ground_(std::make_shared<GroundCache>(memory_for_ground(options.memory_bytes, 0))) {}

std::shared_ptr<const HeldSurface> HeldAreas::get(const Box& whole, const Box& part, SurfaceForm needed,
                                                  CallProgress& call) {
  for (;;) {
    const Claim claimed = claim(whole, part, needed);
    if (!claimed.area) return nullptr;
    if (claimed.to_read) return read(claimed.area, call);
    // Where another thread's reading fails or is cancelled, this one tries.
    if (Surface surface = await(claimed.area->surface, call)) return surface;
  }
}

HeldAreas::Claim HeldAreas::claim(const Box& whole, const Box& part, SurfaceForm needed) {
  const std::lock_guard lock(mutex_);
  if (auto held = find(part, needed)) return {std::move(held), false};
  auto area = area_about(whole, needed);
  if (!area) area = area_about(part, needed);
  if (area) add(area);
  return {area, true};
}

std::shared_ptr<HeldAreas::Area> HeldAreas::find(const Box& box, SurfaceForm needed) {
  const auto found = std::find_if(areas_.begin(), areas_.end(), [&](const auto& area) {
    return intersection(area->box, box) == box && (area->form == needed || area->form == SurfaceForm::kTriangles);
  });
  if (found == areas_.end()) return nullptr;
  areas_.splice(areas_.begin(), areas_, found);
  return *found;
}

std::shared_ptr<HeldAreas::Area> HeldAreas::area_about(const Box& box, SurfaceForm needed) const {
  const double side = side_for(box);
  for (const Box& area : {squares_about(box, side, side), squares_about(box, side, 0), box}) {
    const bool posts =
        needed == SurfaceForm::kPosts && options_.lattices && is_full_ &&
        LatticeReader::may_open(store_, Window::box(area), themes_, options_.memory_bytes / kBytesPerPost);
    const SurfaceForm form = posts ? SurfaceForm::kPosts : SurfaceForm::kTriangles;
    const std::uint64_t bytes = bytes_held(store_, detail_, area, form);
    if (bytes <= options_.memory_bytes) return std::make_shared<Area>(Area{.box = area, .form = form, .bytes = bytes});
  }
  return nullptr;
}

/// Adds an area, and drops as many of the areas used longest ago as the memory does not hold beside it and the ground
/// of cells. A single area may take what that would have.
void HeldAreas::add(std::shared_ptr<Area> area) {
  ++readings_;
  const std::uint64_t most = most_for_areas();
  const std::uint64_t bytes = area->bytes + drop_surplus(most - std::min(most, area->bytes));
  areas_.push_front(std::move(area));
  ground_->limit(memory_for_ground(options_.memory_bytes, bytes));
}

/// The memory that several areas may take together.
std::uint64_t HeldAreas::most_for_areas() const {
  return options_.memory_bytes - memory_for_ground(options_.memory_bytes, 0);
}

/// Drops the areas used longest ago that do not fit, and returns what the others take.
std::uint64_t HeldAreas::drop_surplus(std::uint64_t most_bytes) {
  std::uint64_t bytes = 0;
  const auto too_many = std::find_if(areas_.begin(), areas_.end(), [&](const auto& held) {
    if (bytes + held->bytes > most_bytes) return true;
    bytes += held->bytes;
    return false;
  });
  areas_.erase(too_many, areas_.end());
  return bytes;
}

HeldAreas::Surface HeldAreas::read(const std::shared_ptr<Area>& area, CallProgress& call) {
  try {
    // A thread that waits for the loops of a limit of its own takes up no work of the caller's meanwhile, which might
    // wait for this very area.
    const ThreadLimit own(thread_count());
    ComputeOptions options = options_;
    options.lattices = area->form == SurfaceForm::kPosts;
    const Surface surface(
        new HeldSurface(store_, area->box, detail_, themes_, options, ground_, call.step(kReadingArea)));
    call.step(1);
    area->read.set_value(surface);
    return surface;
  } catch (const InputError&) {
    // What seemed to be a lattice takes more as triangles.
    give_up(*area);
    return nullptr;
  } catch (...) {
    give_up(*area);
    throw;
  }
}

void HeldAreas::give_up(Area& area) {
  {
    const std::lock_guard lock(mutex_);
    areas_.remove_if([&](const auto& held) { return held.get() == &area; });
  }
  area.read.set_value(nullptr);
}

std::uint64_t HeldAreas::keep(std::uint64_t most_bytes) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t bytes = drop_surplus(most_bytes);
  const std::uint64_t ground = std::min(memory_for_ground(options_.memory_bytes, bytes), most_bytes - bytes);
  ground_->limit(ground);
  return bytes + ground;
}

void HeldAreas::prefetch(const Box& box, CallProgress& call) {
  if (const auto area = claim_beside_last(box)) read(area, call);
}

/// Returns an area to be read; null where none is needed, or none fits.
std::shared_ptr<HeldAreas::Area> HeldAreas::claim_beside_last(const Box& box) {
  const std::lock_guard lock(mutex_);
  if (find(box, SurfaceForm::kPosts)) return nullptr;
  auto area = area_about(box, SurfaceForm::kPosts);
  const std::uint64_t last = areas_.empty() ? 0 : areas_.front()->bytes;
  if (!area || (last > 0 && last + area->bytes > most_for_areas())) return nullptr;
  add(area);
  return area;
}

std::vector<Box> HeldAreas::areas() const {
  const std::lock_guard lock(mutex_);
  std::vector<Box> boxes;
  for (const auto& area : areas_) boxes.push_back(area->box);
  return boxes;
}

std::uint64_t HeldAreas::readings() const {
  const std::lock_guard lock(mutex_);
  return readings_;
}

}  // namespace itin::viewshed
