#include "store/segments/footprint_codec.hpp"

#include <limits>
#include <optional>
#include <string>

#include "store/codec/zstd_frame.hpp"
#include "store/segments/content_stream.hpp"

namespace itin {

namespace {

constexpr std::size_t kMostFootprintBytes = std::size_t{1} << 30;
constexpr auto kLastKind = static_cast<std::uint64_t>(FeatureKind::cells);
constexpr auto kLastRoof = static_cast<std::uint64_t>(RoofKind::skeleton);
constexpr auto kLastBase = static_cast<std::uint64_t>(BaseRule::terrain_following);
constexpr auto kLastRounding = static_cast<std::uint64_t>(HeightRounding::down);
constexpr std::uint64_t kFlatFoundation = kLastBase + 1;  ///< added to the base rule
constexpr std::uint64_t kMostCells = 0x7fffffff;

class Writer : public ContentWriter {
 public:
  void optional(const std::optional<double>& v) {
    whole(v ? 1 : 0);
    if (v) number(*v);
  }
  void place(Point2 p) { number(p.x), number(p.y); }
};

class Reader : public ContentReader {
 public:
  using ContentReader::ContentReader;
  std::int32_t small(std::uint64_t most) { return static_cast<std::int32_t>(whole(most)); }
  Point2 place() {
    const double x = number(), y = number();
    return {x, y};
  }
  std::optional<double> optional() { return whole(1) == 1 ? std::optional(number()) : std::nullopt; }
};

void write(Writer& out, const HeightCells& c) {
  for (const Point2& p : {c.corner, c.across, c.down}) out.place(p);
  for (const std::int32_t v : {c.first_column, c.first_row, c.columns, c.rows, c.step, c.threshold})
    out.whole(static_cast<std::uint64_t>(v));
  out.whole(c.absolute ? 1 : 0);
  out.whole(static_cast<std::uint64_t>(c.rounding));
  std::int64_t before = 0;
  for (const std::int32_t h : c.heights) {
    out.whole(h == kNoHeight ? 0 : 1);
    if (h == kNoHeight) continue;
    out.change(h - before);
    before = h;
  }
}

void write(Writer& out, const FootprintFeature& f) {
  out.text(f.name);
  out.whole(static_cast<std::uint64_t>(f.kind));
  out.whole(static_cast<std::uint64_t>(f.roof));
  out.whole(static_cast<std::uint64_t>(f.base_rule) + (f.flat_foundation ? kFlatFoundation : 0));
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
  if (f.cells) write(out, *f.cells);
}

HeightCells read_height_cells(Reader& in) {
  HeightCells c;
  for (Point2* p : {&c.corner, &c.across, &c.down}) *p = in.place();
  for (std::int32_t* v : {&c.first_column, &c.first_row, &c.columns, &c.rows, &c.step, &c.threshold})
    *v = in.small(kMostCells);
  c.absolute = in.whole(1) == 1;
  c.rounding = static_cast<HeightRounding>(in.whole(kLastRounding));
  std::int64_t before = 0;
  for (std::int64_t n = std::int64_t{c.columns} * c.rows; n > 0; --n) {
    if (in.whole(1) == 0) {
      c.heights.push_back(kNoHeight);
      continue;
    }
    before += in.change();
    if (before <= kNoHeight || before > std::numeric_limits<std::int32_t>::max())
      throw DecodeError("a height is out of range");
    c.heights.push_back(static_cast<std::int32_t>(before));
  }
  if (c.step == 0) throw DecodeError("a step of heights is 0");
  return c;
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
  f.kind = static_cast<FeatureKind>(in.whole(kLastKind));
  f.roof = static_cast<RoofKind>(in.whole(kLastRoof));
  const std::uint64_t base = in.whole(kFlatFoundation + kLastBase);
  f.flat_foundation = base >= kFlatFoundation;
  f.base_rule = static_cast<BaseRule>(base % kFlatFoundation);
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
  if (f.kind == FeatureKind::cells) f.cells = read_height_cells(in);
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
