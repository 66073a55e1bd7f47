// The result of a plan's segment as bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <viewshed/plan.hpp>

namespace itin::viewshed {

/// Returns all of the result that does not follow from the plan. Equal results give equal bytes.
std::string segment_bytes(const Result& result);

/// The inverse of segment_bytes(). Throws NotThoseValues for bytes of anything else.
Result segment_result(std::string_view bytes, const Plan& plan, std::size_t segment);

}  // namespace itin::viewshed
