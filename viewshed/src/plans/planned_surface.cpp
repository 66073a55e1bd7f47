#include "plans/planned_surface.hpp"

#include <algorithm>

#include <itin/error.hpp>

namespace itin::viewshed {

namespace {

bool same_detail(const Detail& a, const Detail& b) {
  const auto same = [](const Ring& r, const Ring& s) { return r.radius == s.radius && r.tolerance == s.tolerance; };
  return a.centre() == b.centre() &&
         std::equal(a.rings().begin(), a.rings().end(), b.rings().begin(), b.rings().end(), same);
}

}  // namespace

void require_surface_of(const Plan& plan, const Store& store, const Detail& detail, const ThemeChoice& themes) {
  if (!plan.decides_exactly())
    throw InputError("a plan over a coarse level is decided over its store, not over a surface that is held");
  const bool certified = plan.certainty() == Certainty::kCertified;
  if (!same_detail(detail, certified ? Detail::tolerance(0) : plan.request().detail))
    throw InputError("the surface that is held has another `detail` than the plan", "detail");
  const std::vector<ThemeInfo>& all = store.metadata().themes;
  if (themes.names(all) != plan.request().themes.names(all) || themes.omitted() != plan.request().themes.omitted())
    throw InputError("the surface that is held has other `themes` than the plan", "themes");
}

}  // namespace itin::viewshed
