// LAZ files of point formats 0 to 3 and 6 to 8, as bytes, for tests of the reader: a plain encoder of what the reader
// decodes. What the reader passes over, times and colours and extra bytes, is any sequence of symbols.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "import/lidar/laz/return_contexts.hpp"
#include "import/lidar/laz/running_median.hpp"
#include "import/lidar/laz/symbol_model.hpp"
#include "support/las_writer.hpp"

namespace itin::test {

/// A range encoder. Its interval is written digit by digit; a carry goes back into digits that were written.
class RangeEncoder {
 public:
  void symbol(SymbolModel& model, std::uint32_t symbol) {
    const std::uint32_t whole = length_;
    length_ >>= SymbolModel::kScaleBits;
    const std::uint32_t from = model.below(symbol) * length_;
    narrow(from, (symbol == model.last() ? whole : model.below(symbol + 1) * length_) - from);
    model.count(symbol);
  }
  void bit(BitModel& model, bool one) {
    const std::uint32_t split = model.below_one() * (length_ >> BitModel::kScaleBits);
    one ? narrow(split, length_ - split) : narrow(0, split);
    model.count(one);
  }
  void bits(std::uint32_t value, unsigned count) {
    if (count > 19) {
      bits(value & 0xffff, 16);
      return bits(value >> 16, count - 16);
    }
    length_ >>= count;
    narrow(value * length_, length_);
  }
  /// The bytes, if anything was encoded.
  std::string finished() {
    if (!used_) return {};
    for (int i = 0; i < 4; ++i, low_ <<= 8) bytes_.push_back(static_cast<char>(low_ >> 24));
    return bytes_;
  }

 private:
  void narrow(std::uint32_t from, std::uint32_t length) {
    used_ = true;
    low_ += from;
    if (low_ < from)
      for (auto digit = bytes_.rbegin(); ++*digit == 0;) ++digit;
    for (length_ = length; length_ < 1U << 24; length_ <<= 8, low_ <<= 8)
      bytes_.push_back(static_cast<char>(low_ >> 24));
  }

  std::string bytes_;
  std::uint32_t low_ = 0, length_ = 0xffffffff;
  bool used_ = false;
};

class IntegerEncoder {
 public:
  IntegerEncoder(unsigned bits, unsigned contexts) : widths_(contexts, SymbolModel(bits + 1)) {}

  void difference(RangeEncoder& out, std::int32_t number, unsigned context) {
    const std::uint32_t size =
        number <= 0 ? 0 - static_cast<std::uint32_t>(number) : static_cast<std::uint32_t>(number) - 1;
    width = static_cast<unsigned>(std::bit_width(size));
    out.symbol(widths_.at(context), width);
    if (width == 0) return out.bit(narrowest_, number == 1);
    if (width == 32) return;
    const std::uint32_t place =
        number < 0 ? static_cast<std::uint32_t>(number) + (1U << width) - 1 : static_cast<std::uint32_t>(number) - 1;
    const unsigned lower = width > 8 ? width - 8 : 0;
    out.symbol(high_.try_emplace(width, 1U << (width - lower)).first->second, place >> lower);
    if (lower > 0) out.bits(place & ((1U << lower) - 1), lower);
  }
  void next(RangeEncoder& out, std::int32_t predicted, std::int32_t number, unsigned context) {
    difference(out,
               static_cast<std::int32_t>(static_cast<std::uint32_t>(number) - static_cast<std::uint32_t>(predicted)),
               context);
  }
  unsigned width = 0;

 private:
  std::vector<SymbolModel> widths_;
  std::map<unsigned, SymbolModel> high_;
  BitModel narrowest_;
};

/// A point, and what else decides how it is encoded.
struct LazRecordOf {
  LasRecord point;
  PulseReturn pulse_return{1, 1};
  bool new_time = false;
  unsigned channel = 0;  ///< formats 6 and later
  std::uint8_t user = 0;
};

/// Attributes that the reader passes over, at random.
class AnyAttributes {
 public:
  AnyAttributes(int format, int extra_bytes, std::mt19937& random)
      : times_(format == 1 || format == 3),
        colours_(format == 2 || format == 3),
        random_(random),
        extra_(static_cast<std::size_t>(extra_bytes), SymbolModel(256)) {}

  void write(RangeEncoder& out) {
    if (times_) write_time(out);
    if (colours_) {
      const std::uint32_t changed = below(128);
      out.symbol(changed_, changed);
      for (const unsigned byte : {0U, 1U, 2U, 4U, 3U, 5U})
        if ((changed >> byte & 1) != 0 && (byte < 2 || changed >= 64)) out.symbol(colour_bytes_[byte], below(256));
    }
    for (SymbolModel& byte : extra_) out.symbol(byte, below(256));
  }

 private:
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
  std::int32_t any() { return static_cast<std::int32_t>(random_() >> random_() % 32); }

  void write_time(RangeEncoder& out) {
    std::int32_t& step = steps_[current_];
    if (step == 0) {
      const std::uint32_t symbol = below(6);
      out.symbol(first_, symbol);
      if (symbol == 1) difference_.difference(out, step = any(), 0);
      if (symbol == 1) unlike_[current_] = 0;
      if (symbol == 2) whole(out);
      if (symbol > 2) current_ = (current_ + symbol - 2) % 4, write_time(out);
      return;
    }
    constexpr std::array<std::uint32_t, 12> kRare{0, 0, 1, 500, 510, 511, 512, 513, 514, 515, 500, 510};
    const std::uint32_t symbol = below(2) == 0 ? below(516) : kRare[below(12)];
    out.symbol(multiple_, symbol);
    if (symbol == 511) return;
    if (symbol == 512) return whole(out);
    if (symbol > 512) {
      current_ = (current_ + symbol - 512) % 4;
      return write_time(out);
    }
    const std::int32_t number = any();
    const unsigned context = symbol == 0     ? 7
                             : symbol == 1   ? 1
                             : symbol < 10   ? 2
                             : symbol < 500  ? 3
                             : symbol == 500 ? 4
                             : symbol < 510  ? 5
                                             : 6;
    difference_.difference(out, number, context);
    if (symbol == 1) unlike_[current_] = 0;
    if (context != 7 && context != 4 && context != 6) return;
    const std::uint32_t multiple = symbol == 0 ? 0U : symbol == 500 ? 500U : 0U - 10U;
    if (++unlike_[current_] <= 3) return;
    step = static_cast<std::int32_t>(static_cast<std::uint32_t>(step) * multiple + static_cast<std::uint32_t>(number));
    unlike_[current_] = 0;
  }
  void whole(RangeEncoder& out) {
    difference_.difference(out, any(), 8);
    out.bits(below(1 << 16), 16), out.bits(below(1 << 16), 16);
    current_ = newest_ = (newest_ + 1) % 4;
    steps_[current_] = 0, unlike_[current_] = 0;
  }

  bool times_, colours_;
  std::mt19937& random_;
  SymbolModel first_{6}, multiple_{516}, changed_{128};
  IntegerEncoder difference_{32, 9};
  std::array<std::int32_t, 4> steps_{};
  std::array<int, 4> unlike_{};
  std::size_t current_ = 0, newest_ = 0;
  std::vector<SymbolModel> colour_bytes_ = std::vector<SymbolModel>(6, SymbolModel(256));
  std::vector<SymbolModel> extra_;
};

struct LazContents {
  LasContents las;  ///< `points` are not looked at
  std::vector<LazRecordOf> points;
  std::uint32_t chunk_points = 50;  ///< in each chunk; with `variable`, in the first one, and one more in each after
  bool variable = false;
  std::uint32_t seed = 1;  ///< what the reader passes over follows from it
};

class LazWriter {
 public:
  explicit LazWriter(const LazContents& contents) : laz_(contents), random_(contents.seed) {}

  std::string bytes() {
    LasContents las = laz_.las;
    las.vlrs.push_back({"laszip encoded", 22204, laszip_record()});
    for (const LazRecordOf& record : laz_.points) las.points.push_back(record.point);
    std::string file = las_bytes(las);
    const std::size_t start = LittleEndian::get<std::uint32_t>(file, 96);
    file.resize(start);
    file[104] = static_cast<char>(file[104] | 0x80);
    LittleEndian::append(file, std::uint64_t{0});
    std::vector<std::array<std::uint32_t, 2>> chunks;
    std::uint32_t size = laz_.chunk_points;
    for (std::size_t next = 0; next < laz_.points.size();) {
      const std::size_t count = std::min<std::size_t>(size, laz_.points.size() - next);
      const std::string chunk = modern() ? layered_chunk(next, count) : plain_chunk(next, count);
      chunks.push_back({static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(chunk.size())});
      file += chunk, next += count;
      if (laz_.variable) ++size;
    }
    LittleEndian::put(file, start, static_cast<std::uint64_t>(file.size()));
    return file + table(chunks);
  }

 private:
  bool modern() const { return laz_.las.point_format >= 6; }

  std::string laszip_record() const {
    const int format = laz_.las.point_format;
    std::vector<std::array<std::uint16_t, 3>> items{modern() ? std::array<std::uint16_t, 3>{10, 30, 3}
                                                             : std::array<std::uint16_t, 3>{6, 20, 2}};
    if (format == 1 || format == 3) items.push_back({7, 8, 2});
    if (format == 2 || format == 3) items.push_back({8, 6, 2});
    if (format == 7) items.push_back({11, 6, 3});
    if (format == 8) items.push_back({12, 8, 3});
    if (const auto extra = static_cast<std::uint16_t>(laz_.las.extra_bytes); extra > 0)
      items.push_back(modern() ? std::array<std::uint16_t, 3>{14, extra, 3}
                               : std::array<std::uint16_t, 3>{0, extra, 2});
    std::string record(34, '\0');
    LittleEndian::put(record, 0, static_cast<std::uint16_t>(modern() ? 3 : 2));
    record[4] = 3, record[5] = 4;
    LittleEndian::put(record, 12, laz_.variable ? 0xffffffffU : laz_.chunk_points);
    for (const std::size_t unknown : {std::size_t{16}, std::size_t{24}})
      LittleEndian::put(record, unknown, ~std::uint64_t{0});
    LittleEndian::put(record, 32, static_cast<std::uint16_t>(items.size()));
    for (const auto& item : items)
      for (const std::uint16_t number : item) LittleEndian::append(record, number);
    return record;
  }

  static std::string table(const std::vector<std::array<std::uint32_t, 2>>& chunks, bool variable) {
    RangeEncoder out;
    IntegerEncoder numbers(32, 2);
    std::array<std::int32_t, 2> last{};
    for (const auto& chunk : chunks)
      for (unsigned i = variable ? 0 : 1; i < 2; ++i) {
        numbers.next(out, last[i], static_cast<std::int32_t>(chunk[i]), i);
        last[i] = static_cast<std::int32_t>(chunk[i]);
      }
    std::string bytes(8, '\0');
    LittleEndian::put(bytes, 4, static_cast<std::uint32_t>(chunks.size()));
    return bytes + out.finished();
  }
  std::string table(const std::vector<std::array<std::uint32_t, 2>>& chunks) const {
    return table(chunks, laz_.variable);
  }

  /// The record of a point as in a file that is not compressed.
  std::string raw(const LazRecordOf& record) const {
    std::string bytes = point_record(laz_.las, record.point);
    const auto& [number, of] = record.pulse_return;
    bytes[14] = static_cast<char>(modern() ? number | of << 4 : number | of << 3);
    if (modern()) bytes[15] = static_cast<char>((record.point.withheld ? 4 : 0) | record.channel << 4);
    bytes[17] = static_cast<char>(record.user);
    return bytes;
  }

  std::string plain_chunk(std::size_t first, std::size_t count) {
    RangeEncoder out;
    AnyAttributes others(laz_.las.point_format, laz_.las.extra_bytes, random_);
    SymbolModel changed(64);
    std::map<int, SymbolModel> returns, classes, users;
    std::array<SymbolModel, 2> angles{SymbolModel(256), SymbolModel(256)};
    IntegerEncoder intensity(16, 4), source(16, 1), easting(32, 2), northing(32, 22), height(32, 20);
    std::array<RunningMedian, 16> eastward, northward;
    std::array<std::int32_t, 8> heights{};
    std::string last = raw(laz_.points[first]);
    const std::string start = last;
    for (std::size_t i = first + 1; i < first + count; ++i) {
      const LazRecordOf& record = laz_.points[i];
      const std::string now = raw(record);
      const auto byte = [](const std::string& bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
      const bool any_intensity = random_() % 2 == 0, any_angle = random_() % 3 == 0, any_source = random_() % 5 == 0;
      out.symbol(changed, (any_source ? 1U : 0U) | (now[17] != last[17] ? 2U : 0U) | (any_angle ? 4U : 0U) |
                              (now[15] != last[15] ? 8U : 0U) | (any_intensity ? 16U : 0U) |
                              (now[14] != last[14] ? 32U : 0U));
      const PulseReturn& r = record.pulse_return;
      const unsigned context = context_of_eight(r);
      const auto changed_byte = [&](std::map<int, SymbolModel>& models, std::size_t at) {
        if (now[at] != last[at]) out.symbol(models.try_emplace(byte(last, at), 256U).first->second, byte(now, at));
      };
      changed_byte(returns, 14);
      if (any_intensity) intensity.difference(out, static_cast<std::int16_t>(random_()), std::min(3U, context));
      changed_byte(classes, 15);
      if (any_angle) out.symbol(angles[byte(now, 14) >> 6 & 1], static_cast<std::uint32_t>(random_() % 256));
      changed_byte(users, 17);
      if (any_source) source.difference(out, static_cast<std::int16_t>(random_()), 0);
      write_plan(out, laz_.points[i - 1], record, {easting, northing, eastward[context], northward[context]});
      std::int32_t& before = heights[r.depth()];
      height.next(out, before, record.point.z, context_of_width((easting.width + northing.width) / 2, 18, r));
      before = record.point.z;
      others.write(out);
      last = now;
    }
    return start + out.finished();
  }

  struct Plan {
    IntegerEncoder &easting, &northing;
    RunningMedian &eastward, &northward;
  };
  static void write_plan(RangeEncoder& out, const LazRecordOf& last, const LazRecordOf& now, Plan plan) {
    const auto step = [](std::int32_t from, std::int32_t to) {
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(to) - static_cast<std::uint32_t>(from));
    };
    const std::int32_t east = step(last.point.x, now.point.x), north = step(last.point.y, now.point.y);
    const PulseReturn& r = now.pulse_return;
    plan.easting.next(out, plan.eastward.get(), east, r.single() ? 1 : 0);
    plan.northing.next(out, plan.northward.get(), north, context_of_width(plan.easting.width, 20, r));
    plan.eastward.add(east), plan.northward.add(north);
  }

  struct Channel {
    LazRecordOf last;
    std::vector<SymbolModel> changed = std::vector<SymbolModel>(8, SymbolModel(128));
    SymbolModel channel{3}, of_pulse{13};
    std::map<unsigned, SymbolModel> counts, numbers, classes, flags;
    IntegerEncoder easting{32, 2}, northing{32, 22}, height{32, 20};
    std::array<RunningMedian, 12> eastward, northward;
    std::array<std::int32_t, 8> heights{};
  };

  std::string layered_chunk(std::size_t first, std::size_t count) {
    std::array<std::unique_ptr<Channel>, 4> channels;
    RangeEncoder plan, heights, classes, flags;
    unsigned current = laz_.points[first].channel;
    const auto begin_channel = [&](unsigned number, const LazRecordOf& record) {
      channels[number] = std::make_unique<Channel>();
      channels[number]->last = record;
      channels[number]->last.new_time = false;
      channels[number]->heights.fill(record.point.z);
    };
    begin_channel(current, laz_.points[first]);
    for (std::size_t i = first + 1; i < first + count; ++i) {
      const LazRecordOf& now = laz_.points[i];
      Channel& before = *channels[current];
      if (!channels[now.channel]) begin_channel(now.channel, before.last);
      Channel& c = *channels[now.channel];
      const PulseReturn &r = now.pulse_return, &last = c.last.pulse_return, &previous = before.last.pulse_return;
      const bool up = r.number == (last.number + 1) % 16, down = r.number == (last.number + 15) % 16;
      const bool other = r.number != last.number && !up && !down;
      plan.symbol(
          before.changed[(previous.first() ? 1U : 0U) | (previous.last() ? 2U : 0U) | (before.last.new_time ? 4U : 0U)],
          (up || other ? 1U : 0U) | (down || other ? 2U : 0U) | (r.of != last.of ? 4U : 0U) |
              (now.new_time ? 16U : 0U) | (now.channel != current ? 64U : 0U));
      if (now.channel != current) plan.symbol(before.channel, (now.channel + 3 - current) % 4);
      if (r.of != last.of) plan.symbol(c.counts.try_emplace(last.of, 16U).first->second, r.of);
      if (other && now.new_time) plan.symbol(c.numbers.try_emplace(last.number, 16U).first->second, r.number);
      if (other && !now.new_time) plan.symbol(c.of_pulse, (r.number + 14 - last.number) % 16);
      const unsigned context = 2 * context_of_sixteen(r) + (now.new_time ? 1 : 0);
      write_plan(plan, c.last, now, {c.easting, c.northing, c.eastward[context], c.northward[context]});
      std::int32_t& height = c.heights[std::min(7U, r.depth())];
      c.height.next(heights, height, now.point.z, context_of_width((c.easting.width + c.northing.width) / 2, 18, r));
      height = now.point.z;
      const unsigned of_class = (c.last.point.classification & 31U) * 2 + (r.first() && r.last() ? 1 : 0);
      classes.symbol(c.classes.try_emplace(of_class, 256U).first->second, now.point.classification);
      flags.symbol(c.flags.try_emplace(c.last.point.withheld ? 4U : 0U, 64U).first->second, now.point.withheld ? 4 : 0);
      c.last = now, current = now.channel;
    }
    std::string bytes = raw(laz_.points[first]), layers;
    LittleEndian::append(bytes, static_cast<std::uint32_t>(count));
    for (RangeEncoder* layer : {&plan, &heights, &classes, &flags}) {
      const std::string own = layer->finished();
      LittleEndian::append(bytes, static_cast<std::uint32_t>(own.size()));
      layers += own;
    }
    const int format = laz_.las.point_format;
    const int others = 5 + (format == 7 ? 1 : 0) + (format == 8 ? 2 : 0) + laz_.las.extra_bytes;
    for (int i = 0; i < others; ++i) LittleEndian::append(bytes, std::uint32_t{0});
    return bytes + layers;
  }

  const LazContents& laz_;
  std::mt19937 random_;
};

}  // namespace itin::test
