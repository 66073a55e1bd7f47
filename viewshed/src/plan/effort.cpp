#include "plan/effort.hpp"

#include "request/request.hpp"

namespace itin::viewshed {

namespace {

constexpr double kPost = 5e-8, kTrianglesPoint = 2.5e-6, kEnvelopePoint = 4e-6;
constexpr double kBinnedPost = 2.5e-8, kBinnedTrianglesPoint = 1.1e-6;
constexpr double kSweptCell = 2.5e-8, kCellOverTriangles = 3e-7, kLine = 1.5e-6, kSweptLine = 1e-7, kRay = 1e-6,
                 kLook = 2e-9;

double effort_of_cell(const Request& request, SurfaceForm form) {
  constexpr double kBlocker = 1e-6, kZone = 3e-6, kOdds = 5e-6, kLosses = 4e-5;
  switch (request.mode) {
    case Mode::kBlocker:
      return kBlocker;
    case Mode::kFresnel:
      return kZone;
    case Mode::kProbability:
      return kOdds;
    case Mode::kLoss:
    case Mode::kLevel:
      return kLosses;
    default:
      return form == SurfaceForm::kPosts ? kSweptCell : casts_rays(request) ? kRay : kCellOverTriangles;
  }
}

}  // namespace

double effort_of_posts(std::uint64_t points) {
  return kPost * static_cast<double>(points);
}

double effort_of_triangles(std::uint64_t points) {
  return kTrianglesPoint * static_cast<double>(points);
}

double effort_of_envelope(std::uint64_t points) {
  return kEnvelopePoint * static_cast<double>(points);
}

double effort_of_lines(double lines) {
  return kLine * lines;
}

double effort_of_looks(double looks) {
  return kLook * looks;
}

double effort_of_swept_lines(double lines) {
  return kSweptLine * lines;
}

Effort effort_of_viewshed(const Request& request, std::uint64_t points, std::uint64_t cells, SurfaceForm form) {
  const bool posts = form == SurfaceForm::kPosts;
  return {posts ? effort_of_posts(points) : effort_of_triangles(points),
          (posts ? kBinnedPost : kBinnedTrianglesPoint) * static_cast<double>(points) +
              effort_of_cell(request, form) * static_cast<double>(request.observers.size() * cells)};
}

}  // namespace itin::viewshed
