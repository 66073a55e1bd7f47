#include "pyramid/set_points_aside.hpp"

#include <algorithm>
#include <functional>
#include <span>

#include "pyramid/points/working_index.hpp"
#include "store/file/leaf_cutter.hpp"

namespace itin {

namespace {

/// Cuts points into blocks, and sets these aside.
class SetAsideWriter {
 public:
  explicit SetAsideWriter(StoreWriter& writer)
      : writer_(writer),
        cutter_(kLeafCapacity, [this](const Cell& cell, std::uint32_t count) { write(cell, count); }) {}
  SetAsideWriter(const SetAsideWriter&) = delete;

  void add(const RawPoint& p) {
    points_.push_back({morton_x(p.code), morton_y(p.code), p.z});
    sources_.push_back(p.source);
    cutter_.add(p.code);
  }
  void finish() { cutter_.finish(); }

 private:
  void write(const Cell& cell, std::uint32_t count) {
    if (count == 0) return;
    writer_.set_aside(cell, std::span(points_).first(count), std::span(sources_).first(count));
    points_.erase(points_.begin(), points_.begin() + count);
    sources_.erase(sources_.begin(), sources_.begin() + count);
  }

  StoreWriter& writer_;
  std::vector<GridPoint> points_;
  std::vector<std::uint16_t> sources_;
  LeafCutter<std::function<void(const Cell&, std::uint32_t)>> cutter_;
};

}  // namespace

void set_points_aside(const SortedPoints& points, const std::vector<SourceInfo>& sources, StoreWriter& writer,
                      Progress& progress) {
  constexpr std::uint64_t kAtOnce = 1 << 16;
  SetAsideWriter set_aside(writer);
  std::vector<RawPoint> buffer;
  auto covered = points.covered().begin();
  const auto end = points.covered().end();
  for (std::uint64_t at = 0; at < points.size(); at += buffer.size()) {
    progress.throw_if_cancelled();
    buffer.resize(std::min(kAtOnce, points.size() - at));
    points.read(at, buffer);
    for (const RawPoint& p : buffer) {
      if (covered != end && covered->point.code == p.code)
        set_aside.add(covered++->point);
      else if (p.level == kDropped && sources[p.source].theme.empty())
        set_aside.add(p);
    }
  }
  set_aside.finish();
}

}  // namespace itin
