#include "store/footprint_codec.hpp"

#include <bit>
#include <optional>
#include <string>

#include "store/byte_stream.hpp"
#include "store/zstd_frame.hpp"

namespace itin {

namespace {

constexpr std::size_t kMostFootprintBytes = std::size_t{1} << 30;
constexpr std::uint64_t kLast = 3;  ///< of every enumeration here

class Writer {
 public:
  void whole(std::uint64_t v) { put_varint(bytes_, v); }
  void number(double v) {
    const auto bits = std::bit_cast<std::uint64_t>(v);
    for (int shift = 0; shift < 64; shift += 8) bytes_.push_back(static_cast<std::uint8_t>(bits >> shift));
  }
  void optional(const std::optional<double>& v) {
    whole(v ? 1 : 0);
    if (v) number(*v);
  }
  void text(const std::string& s) {
    whole(s.size());
    bytes_.insert(bytes_.end(), s.begin(), s.end());
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : in_(bytes) {}
  std::uint64_t whole(std::uint64_t most) { return in_.varint(0, most); }
  /// A number of things that follow, each of at least one byte.
  std::size_t count() { return static_cast<std::size_t>(in_.varint(0, in_.rest().size())); }
  double number() {
    std::uint64_t bits = 0;
    for (int shift = 0; shift < 64; shift += 8) bits |= static_cast<std::uint64_t>(in_.byte()) << shift;
    return std::bit_cast<double>(bits);
  }
  std::optional<double> optional() { return whole(1) == 1 ? std::optional(number()) : std::nullopt; }
  std::string text() {
    std::string s;
    for (std::size_t n = count(); n > 0; --n) s.push_back(static_cast<char>(in_.byte()));
    return s;
  }
  bool at_end() const { return in_.rest().empty(); }

 private:
  ByteReader in_;
};

void write(Writer& out, const FootprintFeature& f) {
  out.text(f.name);
  out.whole(static_cast<std::uint64_t>(f.kind));
  out.whole(static_cast<std::uint64_t>(f.roof));
  out.whole(static_cast<std::uint64_t>(f.base_rule));
  out.optional(f.base);
  out.optional(f.height);
  out.optional(f.eaves);
  out.whole(f.rings.size());
  for (const PlanRing& ring : f.rings) {
    out.whole(ring.size());
    for (const Point2& p : ring) out.number(p.x), out.number(p.y);
  }
  out.whole(f.surfaces.size());
  for (const RoofSurface& surface : f.surfaces) {
    out.whole(surface.rings.size());
    for (const auto& ring : surface.rings) {
      out.whole(ring.size());
      for (const Point3& p : ring) out.number(p.x), out.number(p.y), out.number(p.z);
    }
  }
}

RoofSurface read_surface(Reader& in) {
  RoofSurface surface;
  surface.rings.resize(in.count());
  for (auto& ring : surface.rings) {
    for (std::size_t n = in.count(); n > 0; --n) {
      const double x = in.number(), y = in.number(), z = in.number();
      ring.push_back({x, y, z});
    }
  }
  return surface;
}

StoredFootprint read(Reader& in) {
  StoredFootprint footprint;
  FootprintFeature& f = footprint.feature;
  footprint.source = static_cast<std::uint16_t>(in.whole(0xffff));
  f.name = in.text();
  f.kind = static_cast<FeatureKind>(in.whole(kLast));
  f.roof = static_cast<RoofKind>(in.whole(kLast));
  f.base_rule = static_cast<BaseRule>(in.whole(kLast));
  f.base = in.optional();
  f.height = in.optional();
  f.eaves = in.optional();
  f.rings.resize(in.count());
  for (PlanRing& ring : f.rings) {
    for (std::size_t n = in.count(); n > 0; --n) {
      const double x = in.number(), y = in.number();
      ring.push_back({x, y});
    }
  }
  for (std::size_t n = in.count(); n > 0; --n) f.surfaces.push_back(read_surface(in));
  return footprint;
}

}  // namespace

std::vector<std::uint8_t> encode_footprints(std::span<const StoredFootprint> footprints) {
  Writer out;
  for (const StoredFootprint& footprint : footprints) {
    out.whole(footprint.source);
    write(out, footprint.feature);
  }
  return compress(out.bytes());
}

std::vector<std::uint8_t> content_of(const FootprintFeature& feature) {
  Writer out;
  write(out, feature);
  return out.bytes();
}

std::vector<StoredFootprint> decode_footprints(std::span<const std::uint8_t> bytes) {
  const std::vector<std::uint8_t> content = decompress(bytes, kMostFootprintBytes);
  Reader in(content);
  std::vector<StoredFootprint> footprints;
  while (!in.at_end()) footprints.push_back(read(in));
  return footprints;
}

}  // namespace itin
