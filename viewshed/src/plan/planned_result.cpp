#include "plan/planned_result.hpp"

namespace itin::viewshed {

Result as_planned(const Plan& plan, std::size_t segment, Result result) {
  result.request = plan.request_of(segment);
  add_certainty(plan, result);
  return result;
}

void add_certainty(const Plan& plan, Result& result) {
  result.certified = plan.certainty() == Certainty::kCertified;
  result.decided_exactly = result.certified && plan.decides_exactly();
}

}  // namespace itin::viewshed
