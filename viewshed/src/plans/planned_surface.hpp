// Checks whether a surface that is held can decide segments of a plan.
#pragma once

#include <itin/detail.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <viewshed/plan.hpp>

namespace itin::viewshed {

/// Throws InputError where segments over the store's surface of this detail, with these themes, are not the plan's.
void require_surface_of(const Plan& plan, const Store& store, const Detail& detail, const ThemeChoice& themes);

}  // namespace itin::viewshed
