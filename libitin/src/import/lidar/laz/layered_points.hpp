// Points of formats 6 to 10: each attribute has bytes of its own, so that those that nobody asks for are passed over.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "import/lidar/laz/chunk_decoder.hpp"
#include "import/lidar/laz/integer_decoder.hpp"
#include "import/lidar/laz/return_contexts.hpp"
#include "import/lidar/laz/running_median.hpp"

namespace itin {

class LayeredPoints final : public ChunkDecoder {
 public:
  LayeredPoints(const LazLayout& layout, std::span<const std::uint8_t> bytes);

  void decode(std::span<LazPoint> points) override;
  bool ran_out() const override;

 private:
  /// What is known of the points of one scanner channel: its last point, and statistics.
  struct Channel {
    Channel();

    std::int32_t x = 0, y = 0, z = 0;
    PulseReturn pulse_return;
    std::uint8_t classification = 0;
    std::uint8_t flags = 0;  ///< four bits of the class, then the scan's direction and the edge of the flight line
    bool new_pulse = false;  ///< the time was another than that of the point before

    std::vector<SymbolModel> changed = std::vector<SymbolModel>(8, SymbolModel(128));
    SymbolModel channel{3};
    std::array<std::optional<SymbolModel>, 16> number_of_returns, return_number;
    SymbolModel return_of_pulse{13};
    std::array<std::optional<SymbolModel>, 64> classes, flag_sets;
    IntegerDecoder easting{32, 2}, northing{32, 22}, height{32, 20};
    std::array<RunningMedian, 12> eastward, northward;
    std::array<std::int32_t, 8> heights{};
  };

  Channel& next_channel(std::uint32_t changed);
  void decode_next();
  void decode_return(Channel& channel, std::uint32_t changed);
  void decode_plan(Channel& channel);
  void decode_height(Channel& channel);
  void decode_class(Channel& channel);
  std::uint32_t next_symbol(std::optional<SymbolModel>& model, std::uint32_t symbols, RangeDecoder& layer);

  struct Layer {
    bool present = false;
    RangeDecoder decoder;
  };
  Layer plan_, height_, class_, flags_;
  std::array<std::unique_ptr<Channel>, 4> channels_;
  unsigned current_ = 0;
  bool first_ = true, too_short_ = false;
};

}  // namespace itin
