// Segments of a plan: each one's viewshed, and all of them together.
#include <viewshed/plan.hpp>

#include "certify/certified.hpp"
#include "exact/compute.hpp"
#include "plans/segment_merge.hpp"

namespace itin::viewshed {

Result decide(const Store& store, const Plan& plan, std::size_t segment, Progress& progress) {
  const Request request = plan.request_of(segment);
  if (plan.certainty() == Certainty::kExact) return compute_result(store, request, plan.options(), progress);
  const CertifiedWay way = plan.decides_exactly() ? CertifiedWay::kExactly : certified_way(store, plan.request());
  return compute_certified(store, request, way, plan.options(), progress).result;
}

Merge::Merge(const Plan& plan) : merge_(std::make_unique<SegmentMerge>(plan, SegmentMerge::Cells::kKept)) {}
Merge::~Merge() = default;

void Merge::add(std::size_t segment, const Result& result) {
  merge_->add(segment, result);
}

std::vector<std::size_t> Merge::missing() const {
  return merge_->missing();
}

Result Merge::take() {
  return merge_->take();
}

}  // namespace itin::viewshed
