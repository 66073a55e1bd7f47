// What a surface that is held must be to decide segments of a plan.
#pragma once

#include <cstddef>

#include <itin/detail.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <viewshed/plan.hpp>

namespace itin::viewshed {

/// Throws InputError where segments over the store's surface of this detail, with these themes, are not the plan's.
void require_surface_of(const Plan& plan, const Store& store, const Detail& detail, const ThemeChoice& themes);

/// A segment's exact result as decide() gives it.
Result as_planned(const Plan& plan, std::size_t segment, Result result);

}  // namespace itin::viewshed
