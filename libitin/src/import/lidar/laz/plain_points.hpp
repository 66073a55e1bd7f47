// Points of formats 0 to 3: all attributes of a point, one after the other, in one stream of bytes.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "import/lidar/laz/chunk_decoder.hpp"
#include "import/lidar/laz/passed_over.hpp"
#include "import/lidar/laz/return_contexts.hpp"
#include "import/lidar/laz/running_median.hpp"

namespace itin {

class PlainPoints final : public ChunkDecoder {
 public:
  PlainPoints(const LazLayout& layout, std::span<const std::uint8_t> bytes);

  void decode(std::span<LazPoint> points) override;
  bool ran_out() const override { return decoder_.ran_out(); }

 private:
  /// Models of a byte, each for one value that it had in the point before, which are made where they are needed.
  using ByteModels = std::array<std::unique_ptr<SymbolModel>, 256>;

  void decode_next();
  void decode_attributes(std::uint32_t changed);
  void decode_position();
  std::uint8_t next_byte(ByteModels& models, std::uint8_t before);
  PulseReturn pulse_return() const { return {returns_ & 7U, returns_ >> 3 & 7U}; }

  RangeDecoder decoder_;
  bool first_ = true;

  // The attributes of the last point, as its record has them.
  std::int32_t x_, y_, z_;
  std::uint8_t returns_, class_, user_;

  SymbolModel changed_{64};
  ByteModels return_models_, class_models_, user_models_;
  std::array<SymbolModel, 2> angle_models_{SymbolModel(256), SymbolModel(256)};
  IntegerDecoder intensity_{16, 4}, source_{16, 1};
  IntegerDecoder easting_{32, 2}, northing_{32, 22}, height_{32, 20};
  std::array<RunningMedian, 16> eastward_, northward_;  ///< the last steps from point to point
  std::array<std::int32_t, 8> heights_{};               ///< the last points' heights, by how deep their returns are
  std::optional<PassedTimes> times_;
  std::optional<PassedColours> colours_;
  PassedBytes extra_;
};

}  // namespace itin
