#include <utility>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <viewshed/held_surface.hpp>
#include <viewshed/surface.hpp>

#include "exact/compute.hpp"
#include "plan/planned_result.hpp"
#include "plans/held_areas.hpp"
#include "plans/planned_surface.hpp"
#include "request/request.hpp"
#include "request/request_window.hpp"

namespace itin::viewshed {

class PagedSurface::Impl {
 public:
  Impl(const Store& store, const Detail& detail, const ThemeChoice& themes, const ComputeOptions& options)
      : store_(store), detail_(detail), themes_(themes), options_(options), areas_(store, detail, themes, options) {}

  const Store& store() const { return store_; }
  const Detail& detail() const { return detail_; }
  const ThemeChoice& themes() const { return themes_; }
  const HeldAreas& areas() const { return areas_; }

  /// Computes a request that is a part of `whole`.
  Result compute(Request request, const Request& whole, Progress& progress, const CellSink& sink = {}) {
    request.detail = detail_, request.themes = themes_;
    validate(request);
    const Box under = area_under(store_, request);
    CallProgress call(progress);
    if (!under.empty()) {  // else the store's result says so
      Box under_whole = area_under(store_, whole);
      under_whole.extend(under);
      const SurfaceForm needed =
          needs_triangles(request) || casts_rays(request) ? SurfaceForm::kTriangles : SurfaceForm::kPosts;
      if (const auto surface = areas_.get(under_whole, under, needed, call))
        return surface->compute(request, call, sink);
    }
    return compute_from_store(request, sink, call);
  }

  void prefetch(const Box& box, Progress& progress) {
    const Box on_data = intersection(box, extent_of(store_));
    CallProgress call(progress);
    if (!on_data.empty()) areas_.prefetch(on_data, call);
    call.finish();
  }

 private:
  /// Computes with the half of the memory that the areas used last do not take, or where that is too little with all.
  Result compute_from_store(const Request& request, const CellSink& sink, Progress& progress) {
    ComputeOptions options = options_;
    options.sink = sink;
    const std::uint64_t kept = areas_.keep(options_.memory_bytes / 2);
    options.memory_bytes -= kept;
    try {
      return compute_result(store_, request, options, progress);
    } catch (const InputError&) {
      if (kept == 0) throw;
    }
    areas_.keep(0);
    options.memory_bytes = options_.memory_bytes;
    return compute_result(store_, request, std::move(options), progress);
  }

  const Store& store_;
  Detail detail_;
  ThemeChoice themes_;
  ComputeOptions options_;
  HeldAreas areas_;
};

PagedSurface::PagedSurface(const Store& store, const Detail& detail, const ThemeChoice& themes,
                           const ComputeOptions& options)
    : impl_(std::make_unique<Impl>(store, detail, themes, options)) {}
PagedSurface::PagedSurface(PagedSurface&&) noexcept = default;
PagedSurface& PagedSurface::operator=(PagedSurface&&) noexcept = default;
PagedSurface::~PagedSurface() = default;

const Detail& PagedSurface::detail() const {
  return impl_->detail();
}
const ThemeChoice& PagedSurface::themes() const {
  return impl_->themes();
}
std::vector<Box> PagedSurface::areas() const {
  return impl_->areas().areas();
}
std::uint64_t PagedSurface::readings() const {
  return impl_->areas().readings();
}
void PagedSurface::prefetch(const Box& box, Progress& progress) {
  impl_->prefetch(box, progress);
}
Result PagedSurface::compute(const Request& request, Progress& progress, const CellSink& sink) {
  return impl_->compute(request, request, progress, sink);
}

Result decide(PagedSurface& surface, const Plan& plan, std::size_t segment, Progress& progress) {
  require_surface_of(plan, surface.impl_->store(), surface.detail(), surface.themes());
  return as_planned(plan, segment, surface.impl_->compute(plan.request_of(segment), plan.request(), progress));
}

}  // namespace itin::viewshed
