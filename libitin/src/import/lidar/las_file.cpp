#include "import/lidar/las_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <itin/precondition.hpp>

#include "base/file_bytes.hpp"
#include "import/lidar/laz/laz_points.hpp"

namespace itin {

namespace {

// The bytes of a point record that each format defines; a longer record carries extra bytes.
constexpr std::array<std::uint16_t, 11> kRecordLengths = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
// The sizes of the public headers of LAS 1.0 to 1.2, 1.3 and 1.4.
constexpr std::array<std::uint16_t, 5> kHeaderSizes = {227, 227, 227, 235, 375};

constexpr std::uint16_t kGeoKeyDirectory = 34735;
constexpr std::uint16_t kWktRecord = 2112;
constexpr std::uint16_t kLaszipRecord = 22204;
// Real records are a few kilobytes; a longer one is a damaged length.
constexpr std::uint64_t kLongestRecord = std::uint64_t{1} << 20;

constexpr std::size_t kReadBytes = std::size_t{1} << 20;

int minor_version(FileBytes& bytes) {
  std::array<char, 26> start{};
  bytes.read(0, start, "the LAS header");
  if (std::string_view(start.data(), 4) != "LASF") bytes.fail(0, "not a LAS file (no LASF signature)");
  const int major = static_cast<unsigned char>(start[24]), minor = static_cast<unsigned char>(start[25]);
  if (major != 1 || minor > 4)
    bytes.fail(24, fmt::format("LAS {}.{} is not supported; convert it to LAS 1.4 or older", major, minor));
  return minor;
}

LasHeader read_header(FileBytes& bytes) {
  LasHeader header;
  header.minor_version = minor_version(bytes);
  std::array<char, 375> raw{};
  const std::uint16_t size = kHeaderSizes[static_cast<std::size_t>(header.minor_version)];
  bytes.read(0, std::span(raw).first(size), "the LAS header");

  header.prefers_wkt = (little_endian<std::uint16_t>(&raw[6]) & 0x10) != 0;
  header.header_size = little_endian<std::uint16_t>(&raw[94]);
  header.point_offset = little_endian<std::uint32_t>(&raw[96]);
  header.vlr_count = little_endian<std::uint32_t>(&raw[100]);
  // LASzip marks compression in bit 7 (bit 6 of an older variant).
  const auto format = static_cast<unsigned char>(raw[104]);
  header.compressed = (format & 0xc0) != 0;
  header.point_format = format & 0x3f;
  header.record_length = little_endian<std::uint16_t>(&raw[105]);
  header.point_count = little_endian<std::uint32_t>(&raw[107]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.scale[axis] = little_endian<double>(&raw[131 + 8 * axis]);
    header.offset[axis] = little_endian<double>(&raw[155 + 8 * axis]);
  }
  header.bounds = {little_endian<double>(&raw[187]), little_endian<double>(&raw[203]), little_endian<double>(&raw[179]),
                   little_endian<double>(&raw[195])};
  if (header.minor_version >= 4) {
    header.evlr_offset = little_endian<std::uint64_t>(&raw[235]);
    header.evlr_count = little_endian<std::uint32_t>(&raw[243]);
    // Some writers of 1.4 still fill in the legacy count alone.
    if (const auto count = little_endian<std::uint64_t>(&raw[247]); count != 0) header.point_count = count;
  }
  if (header.header_size < size)
    bytes.fail(94,
               fmt::format("a header of {} bytes is too short for LAS 1.{}", header.header_size, header.minor_version));
  return header;
}

void check_point_layout(const LasHeader& header, const FileBytes& bytes) {
  if (header.point_format >= static_cast<int>(kRecordLengths.size()))
    bytes.fail(104, fmt::format("point format {} is unknown; 0 to 10 are supported", header.point_format));
  const std::uint16_t shortest = kRecordLengths[static_cast<std::size_t>(header.point_format)];
  if (header.record_length < shortest)
    bytes.fail(105, fmt::format("point records of {} bytes are too short for point format {}, which has {}",
                                header.record_length, header.point_format, shortest));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(header.scale[axis]) || header.scale[axis] == 0)
      bytes.fail(131 + 8 * axis, fmt::format("a coordinate scale of {} makes no sense", header.scale[axis]));
    if (!std::isfinite(header.offset[axis]))
      bytes.fail(155 + 8 * axis, fmt::format("a coordinate offset of {} makes no sense", header.offset[axis]));
  }
  if (header.point_offset < header.header_size || header.point_offset > bytes.size())
    bytes.fail(96, fmt::format("point data are said to start at {}, outside the file's {} bytes", header.point_offset,
                               bytes.size()));
}

void check_room(const LasHeader& header, const FileBytes& bytes) {
  if (header.compressed) return;
  const std::uint64_t room = (bytes.size() - header.point_offset) / header.record_length;
  if (header.point_count > room)
    bytes.fail(header.point_offset, fmt::format("the header promises {} points, but the file has room for {}; it is "
                                                "truncated or damaged",
                                                header.point_count, room));
}

/// A variable length record's own header, of either kind.
struct Record {
  std::string user;
  std::uint16_t id = 0;
  std::uint64_t payload_offset = 0;
  std::uint64_t payload_size = 0;
};

Record read_record(FileBytes& bytes, std::uint64_t offset, bool extended) {
  std::array<char, 60> raw{};
  const std::size_t size = extended ? 60 : 54;
  bytes.read(offset, std::span(raw).first(size), "a variable length record");
  Record record;
  record.user.assign(&raw[2], strnlen(&raw[2], 16));
  record.id = little_endian<std::uint16_t>(&raw[18]);
  record.payload_offset = offset + size;
  record.payload_size = extended ? little_endian<std::uint64_t>(&raw[20]) : little_endian<std::uint16_t>(&raw[20]);
  if (record.payload_size > bytes.size() - record.payload_offset)
    bytes.fail(offset + 20, fmt::format("a variable length record of {} bytes runs beyond the end of the file at {}",
                                        record.payload_size, bytes.size()));
  return record;
}

/// Reads the key directory: a header of four shorts, then four per key: id, where its value is, count, value. A key is
/// a code only if its value stands in the directory itself (where = 0).
std::map<std::uint16_t, std::uint16_t> geo_keys(std::string_view payload) {
  std::map<std::uint16_t, std::uint16_t> keys;
  if (payload.size() < 8) return keys;
  const std::size_t stated = little_endian<std::uint16_t>(&payload[6]);
  const std::size_t count = std::min(stated, payload.size() / 8 - 1);
  for (std::size_t i = 1; i <= count; ++i) {
    const char* key = &payload[8 * i];
    if (little_endian<std::uint16_t>(key + 2) == 0)
      keys[little_endian<std::uint16_t>(key)] = little_endian<std::uint16_t>(key + 6);
  }
  return keys;
}

/// What the reader takes from variable length records.
struct Records {
  LasProjectionRecords projection;
  std::string laszip;  ///< the LASzip record; empty where there is none
};

void take_record(FileBytes& bytes, const Record& record, Records& records) {
  const bool laszip = record.user == "laszip encoded" && record.id == kLaszipRecord;
  const bool projection =
      record.user == "LASF_Projection" && (record.id == kGeoKeyDirectory || record.id == kWktRecord);
  if (!laszip && !projection) return;
  const std::string what = laszip ? "LASzip record" : "projection record";
  if (record.payload_size > kLongestRecord)
    bytes.fail(record.payload_offset, fmt::format("a {} of {} bytes is damaged", what, record.payload_size));
  std::string payload(record.payload_size, '\0');
  bytes.read(record.payload_offset, payload, "a " + what);
  if (laszip)
    records.laszip = std::move(payload);
  else if (record.id == kWktRecord)
    records.projection.wkt = payload.substr(0, payload.find('\0'));
  else
    records.projection.geo_keys = geo_keys(payload);
}

Records read_records(FileBytes& bytes, const LasHeader& header) {
  Records records;
  std::uint64_t offset = header.header_size;
  for (std::uint32_t i = 0; i < header.vlr_count; ++i) {
    const Record record = read_record(bytes, offset, false);
    offset = record.payload_offset + record.payload_size;
    if (offset > header.point_offset)
      bytes.fail(record.payload_offset, fmt::format("variable length record {} of {} runs into the point data at {}",
                                                    i + 1, header.vlr_count, header.point_offset));
    take_record(bytes, record, records);
  }
  offset = header.evlr_offset;
  for (std::uint32_t i = 0; i < header.evlr_count; ++i) {
    const Record record = read_record(bytes, offset, true);
    offset = record.payload_offset + record.payload_size;
    take_record(bytes, record, records);
  }
  return records;
}

/// Decodes records of one file.
class Decoder {
 public:
  explicit Decoder(const LasHeader& header) : header_(header), modern_(header.point_format >= 6) {}

  LasPoint operator()(const char* record) const {
    LazPoint point{little_endian<std::int32_t>(record), little_endian<std::int32_t>(record + 4),
                   little_endian<std::int32_t>(record + 8)};
    // Formats 0 to 5 keep class (5 bits) and flags in one byte, later ones in two.
    const auto flags = static_cast<unsigned char>(record[15]);
    point.classification = modern_ ? static_cast<std::uint8_t>(record[16]) : flags & 0x1f;
    point.withheld = (flags & (modern_ ? 0x04 : 0x80)) != 0;
    return (*this)(point);
  }
  LasPoint operator()(const LazPoint& point) const {
    return {point.x * header_.scale[0] + header_.offset[0], point.y * header_.scale[1] + header_.offset[1],
            point.z * header_.scale[2] + header_.offset[2], point.classification, point.withheld};
  }

 private:
  const LasHeader& header_;
  bool modern_;
};

}  // namespace

LasFile::LasFile(std::string path) : path_(std::move(path)) {
  FileBytes bytes(path_);
  file_size_ = bytes.size();
  header_ = read_header(bytes);
  check_point_layout(header_, bytes);
  Records records = read_records(bytes, header_);
  projection_ = std::move(records.projection);
  header_.compressed = header_.compressed || !records.laszip.empty();
  if (header_.compressed) laz_ = laz_layout(path_, records.laszip, {header_.point_format, header_.record_length});
  check_room(header_, bytes);
}

std::uint64_t LasFile::records_not_promised() const {
  // In files with waveforms their data may follow the points.
  const bool waveforms = header_.point_format == 4 || header_.point_format == 5 || header_.point_format >= 9;
  if (header_.compressed || waveforms) return 0;
  const std::uint64_t end = header_.evlr_count > 0 ? std::min(header_.evlr_offset, file_size_) : file_size_;
  const std::uint64_t promised_end = header_.point_offset + header_.point_count * header_.record_length;
  return end > promised_end ? (end - promised_end) / header_.record_length : 0;
}

LasPoint LasFile::first_point() const {
  ITIN_PRECONDITION(header_.point_count > 0);
  FileBytes bytes(path_);
  // Compressed points begin with the place of their chunk table; the first one is not compressed.
  constexpr std::uint64_t kTablePlaceBytes = 8;
  std::array<char, 20> record{};
  bytes.read(header_.point_offset + (laz_ ? kTablePlaceBytes : 0), record, "the first point");
  return Decoder(header_)(record.data());
}

void LasFile::read(const Sink& sink) const {
  laz_ ? read_compressed(sink) : read_plain(sink);
}

void LasFile::read_compressed(const Sink& sink) const {
  const Decoder decode(header_);
  std::vector<LasPoint> batch;
  std::uint64_t done = 0;
  read_laz(path_, *laz_, {header_.point_offset, header_.point_count}, [&](std::span<const LazPoint> points) {
    batch.clear();
    for (const LazPoint& point : points) batch.push_back(decode(point));
    done += points.size();
    sink(batch, static_cast<double>(done) / static_cast<double>(header_.point_count));
  });
}

void LasFile::read_plain(const Sink& sink) const {
  FileBytes bytes(path_);
  const Decoder decode(header_);
  const std::uint64_t length = header_.record_length;
  const std::uint64_t most = std::max<std::uint64_t>(1, kReadBytes / length);
  std::vector<char> raw;
  std::vector<LasPoint> points;
  for (std::uint64_t done = 0; done < header_.point_count;) {
    const std::uint64_t count = std::min(most, header_.point_count - done);
    raw.resize(count * length);
    bytes.read(header_.point_offset + done * length, raw, "the point data");
    points.resize(count);
    for (std::uint64_t i = 0; i < count; ++i) points[i] = decode(&raw[i * length]);
    done += count;
    sink(points, static_cast<double>(done) / static_cast<double>(header_.point_count));
  }
}

}  // namespace itin
