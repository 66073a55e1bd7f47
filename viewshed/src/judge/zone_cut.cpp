#include "judge/zone_cut.hpp"

#include <cmath>

#include <viewshed/result.hpp>

namespace itin::viewshed {

namespace {

/// Four by four cells and their Fresnel zones.
class ZonePacket {
 public:
  ZonePacket(const ClearZone& zone, const Eye& eye, const TileTargets& targets)
      : zone_(zone), eye_(eye), targets_(targets) {
    for (SightLines* const lines : {&low_, &high_}) lines->start_at(eye.units);
  }

  void judge(std::size_t row, std::size_t column, TileValues<Verdict>& values) {
    unsigned visible = 0;
    high_.active = 0;
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      const std::size_t r = row + i / kPacketSide, c = column + i % kPacketSide, cell = r * Tile::kSide + c;
      if (values[cell] != Verdict::kVisible && values[cell] != Verdict::kUndecided) continue;
      aim(i, r, c);
      if (values[cell] == Verdict::kVisible) visible |= 1U << i;
    }
    if (high_.active == 0) return;
    const unsigned cut = zone_.certainly_cut(high_);
    low_.active = targets_.exact() ? 0 : high_.active & visible & ~cut;
    const unsigned open = low_.active == 0 ? 0 : low_.active & ~zone_.certainly_clear(low_);
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      Verdict& value = values[(row + i / kPacketSide) * Tile::kSide + column + i % kPacketSide];
      if ((cut >> i & 1) != 0) value = Verdict::kZoneCut;
      if ((open >> i & 1) != 0) value = Verdict::kUndecided;
    }
  }

 private:
  void aim(unsigned i, std::size_t r, std::size_t c) {
    const double x = targets_.centres.x[c], y = targets_.centres.y[r];
    const std::size_t cell = r * Tile::kSide + c;
    if (eye_.stands_at({x, y}) || std::isnan(targets_.low[cell])) return;
    low_.to_x[i] = high_.to_x[i] = x;
    low_.to_y[i] = high_.to_y[i] = y;
    low_.to_z[i] = targets_.low[cell];
    high_.to_z[i] = targets_.high[cell];
    high_.active |= 1U << i;
  }

  const ClearZone& zone_;
  const Eye& eye_;
  const TileTargets& targets_;
  SightLines low_, high_;  ///< to the lowest and the highest targets
};

}  // namespace

void cut_zones(const ClearZone& zone, const Eye& eye, const TileTargets& targets, const Progress& progress,
               TileValues<Verdict>& values) {
  ZonePacket packet(zone, eye, targets);
  for (std::size_t row = 0; row < Tile::kSide; row += kPacketSide) {
    progress.throw_if_cancelled();
    for (std::size_t column = 0; column < Tile::kSide; column += kPacketSide) packet.judge(row, column, values);
  }
}

}  // namespace itin::viewshed
