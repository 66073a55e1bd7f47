#include "import/lidar/laz/layered_points.hpp"

#include <algorithm>

#include "base/file_bytes.hpp"

namespace itin {

namespace {

// What differs from the last point of the channel, as bits of one symbol. Both of the first two: the return number
// changed in another way.
constexpr std::uint32_t kReturnUp = 1, kReturnDown = 2, kCountChanged = 4, kTimeChanged = 16, kChannelChanged = 64;

constexpr std::uint8_t kLayerWithheld = 0x04;

}  // namespace

LayeredPoints::Channel::Channel() = default;

LayeredPoints::LayeredPoints(const LazLayout& layout, std::span<const std::uint8_t> bytes) {
  const auto channel_of_first = bytes[15] >> 4 & 3U;
  current_ = channel_of_first;
  Channel& channel = *(channels_[current_] = std::make_unique<Channel>());
  channel.x = little_endian<std::int32_t>(&bytes[0]);
  channel.y = little_endian<std::int32_t>(&bytes[4]);
  channel.z = little_endian<std::int32_t>(&bytes[8]);
  channel.pulse_return = {bytes[14] & 15U, static_cast<unsigned>(bytes[14] >> 4)};
  channel.flags = static_cast<std::uint8_t>((bytes[15] & 15U) | (bytes[15] >> 6 & 3U) << 4);
  channel.classification = bytes[16];
  channel.heights.fill(channel.z);

  // The sizes of all layers come before the first one.
  const std::uint8_t* size = &bytes[layout.record_length + 4];
  std::span<const std::uint8_t> rest = bytes.subspan(least_chunk_bytes(layout));
  for (Layer* layer : {&plan_, &height_, &class_, &flags_}) {
    const auto length = little_endian<std::uint32_t>(size);
    size += 4;
    if (length > rest.size()) too_short_ = true;
    const std::span<const std::uint8_t> own = rest.first(std::min<std::size_t>(length, rest.size()));
    if (length > 0) *layer = {true, RangeDecoder(own)};
    rest = rest.subspan(own.size());
  }
}

bool LayeredPoints::ran_out() const {
  const auto ran_out_of = [](const Layer& layer) { return layer.decoder.ran_out(); };
  return too_short_ || ran_out_of(plan_) || ran_out_of(height_) || ran_out_of(class_) || ran_out_of(flags_);
}

void LayeredPoints::decode(std::span<LazPoint> points) {
  for (LazPoint& point : points) {
    if (!first_) decode_next();
    first_ = false;
    const Channel& channel = *channels_[current_];
    point = {channel.x, channel.y, channel.z, channel.classification, (channel.flags & kLayerWithheld) != 0};
  }
}

std::uint32_t LayeredPoints::next_symbol(std::optional<SymbolModel>& model, std::uint32_t symbols,
                                         RangeDecoder& layer) {
  if (!model) model.emplace(symbols);
  return layer.symbol(*model);
}

void LayeredPoints::decode_next() {
  Channel& last = *channels_[current_];
  const PulseReturn& r = last.pulse_return;
  const std::uint32_t changed =
      plan_.decoder.symbol(last.changed[(r.first() ? 1U : 0U) | (r.last() ? 2U : 0U) | (last.new_pulse ? 4U : 0U)]);
  Channel& channel = next_channel(changed);
  channel.new_pulse = (changed & kTimeChanged) != 0;
  decode_return(channel, changed);
  decode_plan(channel);
  if (height_.present) decode_height(channel);
  if (class_.present) decode_class(channel);
  if (flags_.present)
    channel.flags = static_cast<std::uint8_t>(next_symbol(channel.flag_sets[channel.flags], 64, flags_.decoder));
}

LayeredPoints::Channel& LayeredPoints::next_channel(std::uint32_t changed) {
  Channel& last = *channels_[current_];
  if ((changed & kChannelChanged) == 0) return last;
  current_ = (current_ + plan_.decoder.symbol(last.channel) + 1) % 4;
  std::unique_ptr<Channel>& channel = channels_[current_];
  if (channel) return *channel;
  // A channel begins where the last point of another one was.
  channel = std::make_unique<Channel>();
  channel->x = last.x, channel->y = last.y, channel->z = last.z;
  channel->pulse_return = last.pulse_return;
  channel->classification = last.classification, channel->flags = last.flags;
  channel->heights.fill(last.z);
  return *channel;
}

void LayeredPoints::decode_return(Channel& channel, std::uint32_t changed) {
  PulseReturn& r = channel.pulse_return;
  if ((changed & kCountChanged) != 0) r.of = next_symbol(channel.number_of_returns[r.of], 16, plan_.decoder);
  switch (changed & (kReturnUp | kReturnDown)) {
    case kReturnUp:
      r.number = (r.number + 1) % 16;
      break;
    case kReturnDown:
      r.number = (r.number + 15) % 16;
      break;
    case kReturnUp | kReturnDown:
      r.number = channel.new_pulse ? next_symbol(channel.return_number[r.number], 16, plan_.decoder)
                                   : (r.number + plan_.decoder.symbol(channel.return_of_pulse) + 2) % 16;
      break;
    default:
      break;
  }
}

void LayeredPoints::decode_plan(Channel& channel) {
  const PulseReturn& r = channel.pulse_return;
  const unsigned context = 2 * context_of_sixteen(r) + (channel.new_pulse ? 1 : 0);
  RunningMedian &eastward = channel.eastward[context], &northward = channel.northward[context];
  const std::int32_t east = channel.easting.next(plan_.decoder, eastward.get(), r.single() ? 1 : 0);
  const std::int32_t north =
      channel.northing.next(plan_.decoder, northward.get(), context_of_width(channel.easting.width(), 20, r));
  eastward.add(east), northward.add(north);
  channel.x = wrapped_sum(channel.x, east), channel.y = wrapped_sum(channel.y, north);
}

void LayeredPoints::decode_height(Channel& channel) {
  const PulseReturn& r = channel.pulse_return;
  const unsigned width = (channel.easting.width() + channel.northing.width()) / 2;
  std::int32_t& height = channel.heights[std::min(7U, r.depth())];
  channel.z = height = channel.height.next(height_.decoder, height, context_of_width(width, 18, r));
}

void LayeredPoints::decode_class(Channel& channel) {
  const PulseReturn& r = channel.pulse_return;
  const unsigned context = (channel.classification & 31U) * 2 + (r.first() && r.last() ? 1 : 0);
  channel.classification = static_cast<std::uint8_t>(next_symbol(channel.classes[context], 256, class_.decoder));
}

}  // namespace itin
