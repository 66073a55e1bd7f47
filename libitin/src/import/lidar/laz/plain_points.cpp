#include "import/lidar/laz/plain_points.hpp"

#include <algorithm>

#include "base/file_bytes.hpp"

namespace itin {

namespace {

// Attributes that differ from the last point's, as bits of one symbol.
constexpr std::uint32_t kSourceChanged = 1, kUserChanged = 2, kAngleChanged = 4, kClassChanged = 8,
                        kIntensityChanged = 16, kReturnsChanged = 32;

constexpr std::uint8_t kPlainClass = 0x1f, kPlainWithheld = 0x80;

}  // namespace

PlainPoints::PlainPoints(const LazLayout& layout, std::span<const std::uint8_t> bytes)
    : decoder_(bytes.subspan(layout.record_length)),
      x_(little_endian<std::int32_t>(&bytes[0])),
      y_(little_endian<std::int32_t>(&bytes[4])),
      z_(little_endian<std::int32_t>(&bytes[8])),
      returns_(bytes[14]),
      class_(bytes[15]),
      user_(bytes[17]),
      extra_(layout.extra_bytes) {
  if (layout.times) times_.emplace();
  if (layout.colours) colours_.emplace();
}

void PlainPoints::decode(std::span<LazPoint> points) {
  for (LazPoint& point : points) {
    if (!first_) decode_next();
    first_ = false;
    point = {x_, y_, z_, static_cast<std::uint8_t>(class_ & kPlainClass), (class_ & kPlainWithheld) != 0};
  }
}

void PlainPoints::decode_next() {
  decode_attributes(decoder_.symbol(changed_));
  decode_position();
  if (times_) times_->pass(decoder_);
  if (colours_) colours_->pass(decoder_);
  extra_.pass(decoder_);
}

std::uint8_t PlainPoints::next_byte(ByteModels& models, std::uint8_t before) {
  std::unique_ptr<SymbolModel>& model = models[before];
  if (!model) model = std::make_unique<SymbolModel>(256);
  return static_cast<std::uint8_t>(decoder_.symbol(*model));
}

void PlainPoints::decode_attributes(std::uint32_t changed) {
  if ((changed & kReturnsChanged) != 0) returns_ = next_byte(return_models_, returns_);
  if ((changed & kIntensityChanged) != 0)
    intensity_.difference(decoder_, std::min(3U, context_of_eight(pulse_return())));
  if ((changed & kClassChanged) != 0) class_ = next_byte(class_models_, class_);
  if ((changed & kAngleChanged) != 0) decoder_.symbol(angle_models_[returns_ >> 6 & 1U]);  // by the scan's direction
  if ((changed & kUserChanged) != 0) user_ = next_byte(user_models_, user_);
  if ((changed & kSourceChanged) != 0) source_.difference(decoder_, 0);
}

void PlainPoints::decode_position() {
  const PulseReturn r = pulse_return();
  RunningMedian &eastward = eastward_[context_of_eight(r)], &northward = northward_[context_of_eight(r)];
  const std::int32_t east = easting_.next(decoder_, eastward.get(), r.single() ? 1 : 0);
  const std::int32_t north = northing_.next(decoder_, northward.get(), context_of_width(easting_.width(), 20, r));
  eastward.add(east), northward.add(north);
  x_ = wrapped_sum(x_, east), y_ = wrapped_sum(y_, north);
  const unsigned width = (easting_.width() + northing_.width()) / 2;
  std::int32_t& height = heights_[r.depth()];
  z_ = height = height_.next(decoder_, height, context_of_width(width, 18, r));
}

}  // namespace itin
