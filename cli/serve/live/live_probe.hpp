// What is under the cursor: how it lies from a view's first observer, whether it is seen, and what hides it.
//
//   LiveProbe probe(served);
//   const Document answer = probe.answer(options, {318500, 176500});
#pragma once

#include <optional>

#include <itin/celestial_body.hpp>
#include <itin/coordinates.hpp>
#include <itin/document.hpp>
#include <itin/geometry.hpp>

#include "serve/ground/served_store.hpp"

namespace itin::cli {

/// Used by one thread at a time. Far faster than a whole line of sight, which reads its surface anew and tells more.
class LiveProbe {
 public:
  /// `served` must outlive the probe.
  explicit LiveProbe(ServedStore& served);

  /// The answer to a probe at a position in the store's CRS, as PROTOCOL.md describes it. `options` are those of the
  /// view. Throws InputError, also where there is no ground, and what SectionSurface::between() throws.
  Document answer(const Document& options, Point2 position);

 private:
  /// Adds the directions at both ends.
  void add_azimuths(Point2 from, Point2 to, Document& answer);

  ServedStore& served_;
  CelestialBody body_;
  std::optional<CoordinateTransform> to_geographic_;  ///< made by the first answer, for that takes a while
};

}  // namespace itin::cli
