// A choice of sites as a JSON document, in the names that stay.
#pragma once

#include <itin/document.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Returns `value`, `upper_bound`, `chosen` and the rest of the contract's document, without the members that the
/// program adds.
Document site_document(const SitePlan& plan, const StoreMetadata& metadata);

}  // namespace itin::viewshed
