// Decides sight lines by two surfaces that enclose the full one: certainly visible, certainly hidden, or left open.
//
//   const EnvelopeScene scene(envelop(...), request, tiles, NoData::kUnknown);
//   const EnvelopeScene::View view = scene.view_from(eye);
//   EnvelopePacket packet(eye);
//   packet.aim(0, target);
//   const EnvelopeScene::Decided decided = scene.decide(packet);   // packet.low.active is left open
//
// A target is between a lowest and a highest place. If the line to the lowest clears the upper surface, the target is
// seen whatever the full surface is; if the lower surface hides the line to the highest, it is not. Where both are the
// full surface, whatever it does not hide is seen.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <viewshed/request.hpp>

#include "bounds/triangle_bins.hpp"
#include "line/sight_lines.hpp"
#include "request/eye.hpp"
#include "request/void_shadow.hpp"
#include "scene/rays/scene.hpp"
#include "window/envelope.hpp"

namespace itin::viewshed {

/// A target at another place than the eye's, grid units.
struct EnvelopeTarget {
  Point2 place;
  double low = 0, high = 0;
};

/// Sixteen targets that one eye looks for.
struct EnvelopePacket {
  explicit EnvelopePacket(const Eye& eye) {
    for (SightLines* const lines : {&low, &high}) lines->start_at(eye.units);
  }
  /// Makes line `i` lead to the target.
  void aim(unsigned i, const EnvelopeTarget& target) {
    low.to_x[i] = high.to_x[i] = target.place.x;
    low.to_y[i] = high.to_y[i] = target.place.y;
    low.to_z[i] = target.low;
    high.to_z[i] = target.high;
    low.active |= 1U << i;
  }

  SightLines low, high;      ///< to the lowest and to the highest target; active in `low`: those that are asked about
  unsigned behind_void = 0;  ///< one bit per line: left open unless it is hidden
  unsigned perhaps_outside = 0;  ///< one bit per line: perhaps not in the field of view, and left open
};

class EnvelopeScene {
 public:
  EnvelopeScene(Envelope envelope, const Request& request, const RasterGrid& tiles, NoData rule);
  EnvelopeScene(const EnvelopeScene&) = delete;
  EnvelopeScene& operator=(const EnvelopeScene&) = delete;

  struct View {
    Eye eye;
    std::shared_ptr<const VoidShadow> shadow = nullptr;  ///< null where voids are passed
  };
  View view_from(const Eye& eye) const;
  /// The upper surface, which hides what grazes it by half as much, so that what clears it is seen whatever lies below
  /// it. The lower one where both are the full surface.
  const Scene& upper() const { return upper_ ? *upper_ : lower; }

  /// The lines that were decided, one bit per line.
  struct Decided {
    unsigned visible = 0, hidden = 0;
    unsigned lines = 0;  ///< the number of lines that were cast
  };
  /// Decides the packet's lines; lines that are not decided stay active in packet.low.
  Decided decide(EnvelopePacket& packet) const;

  Envelope envelope;
  Scene lower;
  TriangleBins bins;
  std::optional<TriangleBins> ground_bins;  ///< the bare ground's, where the envelope has it
  NoData rule;                              ///< what missing ground does
  bool exact;                               ///< both surfaces are the full one, of level 0
  double drop;                              ///< how far curvature lowers the ground, grid units per squared grid unit

 private:
  std::optional<Scene> upper_;  ///< nothing where both are the full surface
  std::vector<RimEdge> rim_;    ///< where the surface ends; empty where missing ground hides nothing
};

}  // namespace itin::viewshed
