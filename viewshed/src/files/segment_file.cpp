// The result of a plan's segment as a file, from one runner to another.
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include <itin/byte_archive.hpp>
#include <itin/error.hpp>
#include <itin/packed_file.hpp>
#include <viewshed/plan.hpp>

#include "files/segment_bytes.hpp"
#include "modes/mode_values.hpp"
#include "plan/planned_result.hpp"

namespace itin::viewshed {

template <class Archive, class T>
requires std::is_same_v<std::remove_const_t<T>, BlockingTriangle>
void exchange_fields(Archive& archive, T& triangle) {
  for (auto& p : triangle.corners) archive(p.x, p.y, p.z);
  archive(triangle.theme);
}

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
void exchange_result(Archive& archive, R& result) {
  archive(result.visible, result.theme_names, result.cells.visible, result.cells.hidden, result.cells.undecided,
          result.cells.outside, result.cells.zone_cut, result.ground_m, result.crosses_voids, result.warnings);
  std::visit([&](auto& values) { exchange_values(archive, values); }, result.values);
  auto& s = result.statistics;
  // Times are left out, so that the same segment makes the same file whoever computes it.
  archive(s.retrieval.points_read, s.retrieval.blocks_read, s.triangles, s.lines);
}

/// The mark of such a file, which also tells the order of bytes.
constexpr std::uint64_t kKind = 0x31'74'6e'65'6d'67'65'73;

}  // namespace

std::string segment_bytes(const Result& result) {
  ValueWriter writer;
  exchange_result(writer, result);
  return writer.bytes();
}

Result segment_result(std::string_view bytes, const Plan& plan, std::size_t segment) {
  ValueReader reader(bytes);
  Result result;
  result.values = values_outside(plan.request(), 0);
  exchange_result(reader, result);
  reader.expect_end();
  result = as_planned(plan, segment, std::move(result));
  result.grid = *result.request.grid;
  return result;
}

void write_segment(const std::string& path, const Plan& plan, std::size_t segment, const Result& result) {
  ValueWriter writer;
  writer(kKind, plan.id(), std::uint64_t{segment}, segment_bytes(result));
  write_packed(path, writer.bytes());
}

Result read_segment(const std::string& path, const Plan& plan, std::size_t segment) {
  const std::string file = read_packed(path);
  std::uint64_t kind = 0, id = 0, number = 0;
  std::string bytes;
  try {
    ValueReader reader(file);
    reader(kind, id, number);
    if (kind != kKind) throw NotThoseValues();
    if (id != plan.id()) throw InputError(fmt::format("{}: is a segment of another plan", path));
    if (number != segment) throw InputError(fmt::format("{}: is segment {}, not {}", path, number, segment));
    reader(bytes);
    reader.expect_end();
    return segment_result(bytes, plan, segment);
  } catch (const NotThoseValues&) {
    throw FileError(path, "is no segment of a viewshed");
  }
}

}  // namespace itin::viewshed
