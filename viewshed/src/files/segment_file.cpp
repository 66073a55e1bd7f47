// The result of a plan's segment as a file, from one runner to another.
#include <cstring>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/packed_file.hpp>
#include <viewshed/plan.hpp>

#include "modes/mode_values.hpp"
#include "plan/planned_result.hpp"

namespace itin::viewshed {

namespace {

// These serve both directions: they pass every field to an archive, which writes it or reads it.

template <class Archive, class Values>
void exchange_values(Archive& archive, Values& values) {
  using Mode = std::remove_const_t<Values>;
  if constexpr (std::is_same_v<Mode, Counts>) archive(values.count);
  if constexpr (std::is_same_v<Mode, ObserverSets>) archive(values.words);
  if constexpr (std::is_same_v<Mode, Angles>) archive(values.angle_deg);
  if constexpr (std::is_same_v<Mode, NearestObservers>) archive(values.number, values.distance_m);
  if constexpr (std::is_same_v<Mode, Blockers>)
    archive(values.triangles, values.triangle, values.theme, values.feature);
  if constexpr (std::is_same_v<Mode, LeastHeights>) archive(values.height_m);
  if constexpr (std::is_same_v<Mode, Probabilities>) archive(values.probability);
  if constexpr (std::is_same_v<Mode, Losses>) archive(values.diffraction_db, values.free_space_db);
  if constexpr (std::is_same_v<Mode, Levels>) archive(values.level_dbm, values.outage_minutes, values.observer);
}

template <class Archive, class R>
void exchange(Archive& archive, R& result) {
  archive(result.visible, result.theme_names, result.cells.visible, result.cells.hidden, result.cells.undecided,
          result.cells.outside, result.cells.zone_cut, result.ground_m, result.crosses_voids, result.warnings);
  std::visit([&](auto& values) { exchange_values(archive, values); }, result.values);
  auto& s = result.statistics;
  // Times are left out, so that the same segment makes the same file whoever computes it.
  archive(s.retrieval.points_read, s.retrieval.blocks_read, s.triangles, s.lines);
}

template <class T>
inline constexpr bool kIsPlain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

class SegmentWriter {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  requires kIsPlain<T>
  void put(const T& v) { append(&v, sizeof v); }
  void put(const std::string& v) { put_all(v); }
  void put(const BlockingTriangle& v) {
    for (const GridPoint& p : v.corners) (*this)(p.x, p.y, p.z);
    put(v.theme);
  }
  template <class T>
  void put(const std::vector<T>& all) {
    if constexpr (kIsPlain<T>) return put_all(all);
    put(std::uint64_t{all.size()});
    for (const T& v : all) put(v);
  }
  void put_all(const auto& all) {
    put(std::uint64_t{all.size()});
    append(all.data(), all.size() * sizeof *all.data());
  }
  void append(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }

  std::string bytes_;
};

class SegmentReader {
 public:
  SegmentReader(std::string path, std::string bytes) : path_(std::move(path)), bytes_(std::move(bytes)) {}
  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  void expect_end() const {
    if (at_ != bytes_.size()) fail();
  }

 private:
  template <class T>
  requires kIsPlain<T>
  void get(T& v) { take(&v, sizeof v); }
  void get(std::string& v) { get_all(v); }
  void get(BlockingTriangle& v) {
    for (GridPoint& p : v.corners) (*this)(p.x, p.y, p.z);
    get(v.theme);
  }
  template <class T>
  void get(std::vector<T>& all) {
    if constexpr (kIsPlain<T>) return get_all(all);
    all.resize(count(1));
    for (T& v : all) get(v);
  }
  void get_all(auto& all) {
    all.resize(count(sizeof *all.data()));
    take(all.data(), all.size() * sizeof *all.data());
  }
  /// Reads a count of values that take at least `size` bytes each.
  std::size_t count(std::size_t size) {
    std::uint64_t n = 0;
    get(n);
    if (n > (bytes_.size() - at_) / size) fail();
    return n;
  }
  void take(void* data, std::size_t size) {
    if (size > bytes_.size() - at_) fail();
    if (size > 0) std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
  }
  [[noreturn]] void fail() const { throw FileError(path_, "is no segment of a viewshed"); }

  std::string path_;
  std::string bytes_;
  std::size_t at_ = 0;
};

/// The mark of such a file, which also tells the order of bytes.
constexpr std::uint64_t kKind = 0x31'74'6e'65'6d'67'65'73;

}  // namespace

void write_segment(const std::string& path, const Plan& plan, std::size_t segment, const Result& result) {
  SegmentWriter writer;
  writer(kKind, plan.id(), std::uint64_t{segment});
  exchange(writer, result);
  write_packed(path, writer.bytes());
}

Result read_segment(const std::string& path, const Plan& plan, std::size_t segment) {
  SegmentReader reader(path, read_packed(path));
  std::uint64_t kind = 0, id = 0, number = 0;
  reader(kind, id, number);
  if (kind != kKind) throw FileError(path, "is no segment of a viewshed");
  if (id != plan.id()) throw InputError(fmt::format("{}: is a segment of another plan", path));
  if (number != segment) throw InputError(fmt::format("{}: is segment {}, not {}", path, number, segment));
  Result result;
  result.values = values_outside(plan.request(), 0);
  exchange(reader, result);
  reader.expect_end();
  result = as_planned(plan, segment, std::move(result));
  result.grid = *result.request.grid;
  return result;
}

}  // namespace itin::viewshed
