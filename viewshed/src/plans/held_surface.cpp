#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/held_surface.hpp>
#include <viewshed/surface.hpp>

#include "exact/prepared_surface.hpp"
#include "modes/feature_names.hpp"
#include "plan/memory.hpp"
#include "plan/planned_result.hpp"
#include "plans/planned_surface.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"
#include "window/retrieval.hpp"

namespace itin::viewshed {

namespace {

/// About the share of a call's time that reading takes, in calls that read first.
constexpr double kReading = 0.7;

/// A surface with its heights binned, what finds its triangles, and the ground of cells on it.
struct Binned {
  Binned(Tin of, std::shared_ptr<GroundCache> cache)
      : tin(std::move(of)),
        finders(tin),
        heights(std::make_shared<BinnedHeights>(tin)),
        ground(heights, &tin, std::move(cache)) {}
  const Tin tin;
  const TriangleFinders finders;
  const std::shared_ptr<BinnedHeights> heights;
  const KeptGround ground;
};

/// The posts of a lattice, likewise.
struct BinnedPosts {
  BinnedPosts(std::unique_ptr<LatticeReader> of, std::shared_ptr<GroundCache> cache)
      : reader(std::move(of)),
        heights(std::make_shared<BinnedHeights>(reader->lattice())),
        ground(heights, nullptr, std::move(cache)) {}
  const std::unique_ptr<LatticeReader> reader;
  const std::shared_ptr<BinnedHeights> heights;
  const KeptGround ground;
};

/// What ends stand on, where features stand.
struct BareGround {
  BareGround(Tin of, std::shared_ptr<GroundCache> cache)
      : tin(std::move(of)), finders(tin), ground(tin, std::move(cache)) {}
  const Tin tin;
  const TriangleFinders finders;
  const KeptGround ground;
};

}  // namespace

class HeldSurface::Impl {
 public:
  Impl(const Store& store, const Box& area, const Detail& detail, const ThemeChoice& themes,
       const ComputeOptions& options, std::shared_ptr<GroundCache> cache, Progress& progress)
      : store_(store), area_(area), detail_(detail), themes_(themes), cache_(std::move(cache)) {
    if (area.empty()) throw InputError("area: it is empty; give a box in metres", "area");
    CallProgress call(progress);
    const Window window = Window::box(area);
    if (options.lattices) retrieve_posts(window, options, call);
    if (!posts_) retrieve_triangles(window, options.memory_bytes, call);
    call.finish();
  }

  const Store& store() const { return store_; }
  const Box& area() const { return area_; }
  const Detail& detail() const { return detail_; }
  const ThemeChoice& themes() const { return themes_; }

  std::uint64_t bytes() const {
    const std::lock_guard lock(listing_);
    return (posts_ ? bytes_held(store_, detail_, area_, SurfaceForm::kPosts) : 0) +
           (triangles_ ? bytes_held(store_, detail_, area_, SurfaceForm::kTriangles) : 0);
  }

  void keep_ground(std::uint64_t most_bytes) const { cache_->limit(most_bytes); }

  bool covers(const Request& request) const {
    const Box asked = area_under(store_, request);
    return asked.empty() || intersection(area_, asked) == asked;
  }

  Result compute(Request request, Progress& progress, const CellSink& sink) const {
    request.detail = detail_, request.themes = themes_;
    validate(request);
    if (!covers(request))
      throw InputError(fmt::format("sight lines leave the surface that is held, {:.0f},{:.0f} to {:.0f},{:.0f}: give a "
                                   "smaller `radius`, or hold a larger area",
                                   area_.xmin, area_.ymin, area_.xmax, area_.ymax),
                       "radius");
    CallProgress call(progress);
    const PreparedSurface over = surface_for(request, call);
    Result result = viewshed::compute(over, request, call, sink);
    name_features(store_, result, call);
    call.finish();
    return result;
  }

 private:
  void retrieve_posts(const Window& window, const ComputeOptions& options, Progress& progress) {
    auto surface = retrieve_lattice(store_, window, detail_, themes_, LatticeReader::Heights::kAll,
                                    options.memory_bytes / kBytesPerPost, progress);
    if (!surface) return;
    posts_.emplace(std::move(surface->lattice), cache_);
  }

  void retrieve_triangles(const Window& window, std::uint64_t memory, CallProgress& call) {
    require_memory(memory);
    const bool raised = themes_.includes_raised(store_.metadata().themes);
    triangles_.emplace(triangulate(store_, window, detail_, call.step(raised ? 0.7 : 1), themes_), cache_);
    if (raised) bare_.emplace(triangulate(store_, window, detail_, call.step(1), ThemeChoice::none()), cache_);
  }

  void require_memory(std::uint64_t memory) const {
    const std::uint64_t needed = bytes_held(store_, detail_, area_, SurfaceForm::kTriangles);
    if (needed > memory)
      throw InputError(fmt::format("the surface takes about {:.0f} MB: give more `memory_bytes`, or a smaller area",
                                   static_cast<double>(needed) / 1e6),
                       "memory_bytes");
  }

  PreparedSurface surface_for(const Request& request, CallProgress& call) const {
    PreparedSurface over{.bare = bare_ ? &bare_->tin : nullptr, .extent = extent_of(store_)};
    if (posts_ && !needs_triangles(request) && !casts_rays(request)) {
      over.lattice = &posts_->reader->lattice(), over.heights = posts_->heights, over.ground = &posts_->ground;
      return over;
    }
    const Binned& triangles = listed(call);
    over.tin = &triangles.tin, over.heights = triangles.heights, over.finders = &triangles.finders;
    if (bare_) over.bare_finders = &bare_->finders;
    over.ground = bare_ && !request.targets_on_surface ? &bare_->ground : &triangles.ground;
    return over;
  }

  /// Lists the triangles of a lattice when they are first asked for.
  const Binned& listed(CallProgress& call) const {
    const std::lock_guard lock(listing_);
    if (triangles_) return *triangles_;
    triangles_.emplace(triangulate(store_, Window::box(area_), detail_, call.step(kReading), themes_), cache_);
    call.step(1);
    return *triangles_;
  }

  const Store& store_;
  Box area_;
  Detail detail_;
  ThemeChoice themes_;
  std::shared_ptr<GroundCache> cache_;
  std::optional<BinnedPosts> posts_;  ///< where the surface is a lattice
  mutable std::mutex listing_;
  mutable std::optional<Binned> triangles_;
  std::optional<BareGround> bare_;
};

HeldSurface::HeldSurface(const Store& store, const Box& area, const Detail& detail, const ThemeChoice& themes,
                         const ComputeOptions& options, Progress& progress)
    : HeldSurface(store, area, detail, themes, options, std::make_shared<GroundCache>(0), progress) {
  impl_->keep_ground(memory_for_ground(options.memory_bytes, bytes()));
}
HeldSurface::HeldSurface(const Store& store, const Box& area, const Detail& detail, const ThemeChoice& themes,
                         const ComputeOptions& options, std::shared_ptr<GroundCache> cache, Progress& progress)
    : impl_(std::make_unique<const Impl>(store, area, detail, themes, options, std::move(cache), progress)) {}
HeldSurface::HeldSurface(HeldSurface&&) noexcept = default;
HeldSurface& HeldSurface::operator=(HeldSurface&&) noexcept = default;
HeldSurface::~HeldSurface() = default;

const Box& HeldSurface::area() const {
  return impl_->area();
}
const Detail& HeldSurface::detail() const {
  return impl_->detail();
}
const ThemeChoice& HeldSurface::themes() const {
  return impl_->themes();
}
std::uint64_t HeldSurface::bytes() const {
  return impl_->bytes();
}
bool HeldSurface::covers(const Request& request) const {
  return impl_->covers(request);
}
Result HeldSurface::compute(const Request& request, Progress& progress, const CellSink& sink) const {
  return impl_->compute(request, progress, sink);
}

Result decide(const HeldSurface& surface, const Plan& plan, std::size_t segment, Progress& progress) {
  require_surface_of(plan, surface.impl_->store(), surface.detail(), surface.themes());
  return as_planned(plan, segment, surface.compute(plan.request_of(segment), progress));
}

}  // namespace itin::viewshed
