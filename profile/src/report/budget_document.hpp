// A link budget as a JSON document.
#pragma once

#include <itin/document.hpp>
#include <profile/los.hpp>

namespace itin::profile {

/// Precondition: the report has a budget.
Document budget_document(const LosReport& report);

}  // namespace itin::profile
