#include "pyramid/points/sorted_points.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/precondition.hpp>

#include "base/temporary_file.hpp"

namespace itin {

namespace {

constexpr std::uint64_t kPointBytes = sizeof(RawPoint);
constexpr std::uint64_t kIndexStep = 1024;            // points between two entries of the sparse index
constexpr std::uint64_t kLargestChunk = 1 << 22;      // points sorted as one run
constexpr std::uint64_t kChunksInMemory = 8;          // chunks sorted in parallel
constexpr std::uint64_t kSmallestMergeBuffer = 1024;  // points; below this, reading costs more than another pass
constexpr std::uint64_t kLargestMergeBuffer = 1 << 18;
constexpr std::uint64_t kProgressStep = 1 << 20;  // points between two reports

void read_points(const TemporaryFile& file, std::uint64_t first, std::span<RawPoint> out) {
  file.read(first * kPointBytes, out.data(), out.size_bytes());
}

void write_points(TemporaryFile& file, std::uint64_t first, std::span<const RawPoint> points) {
  file.write(first * kPointBytes, points.data(), points.size_bytes());
}

/// Points [first, last) of a file, in ascending order of code.
struct Run {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};

/// Reads a run through a buffer. Precondition: the run is not empty.
class RunReader {
 public:
  RunReader(const TemporaryFile& file, Run run, std::uint64_t buffer_points) : file_(&file), rest_(run) {
    ITIN_PRECONDITION(run.first < run.last);
    buffer_.resize(std::min(buffer_points, run.last - run.first));
    refill();
  }
  const RawPoint& point() const { return buffer_[at_]; }
  /// Moves to the next point; false at the end of the run.
  bool next() {
    if (++at_ < filled_) return true;
    if (rest_.first == rest_.last) return false;
    refill();
    return true;
  }

 private:
  void refill() {
    filled_ = std::min<std::uint64_t>(buffer_.size(), rest_.last - rest_.first);
    read_points(*file_, rest_.first, std::span(buffer_).first(filled_));
    rest_.first += filled_;
    at_ = 0;
  }

  const TemporaryFile* file_;
  Run rest_;
  std::vector<RawPoint> buffer_;
  std::uint64_t at_ = 0, filled_ = 0;
};

/// Appends to a file through a buffer.
class RunWriter {
 public:
  RunWriter(TemporaryFile& file, std::uint64_t first, std::uint64_t buffer_points) : file_(&file), next_(first) {
    buffer_.reserve(buffer_points);
  }
  void append(const RawPoint& point) {
    buffer_.push_back(point);
    if (buffer_.size() == buffer_.capacity()) flush();
  }
  /// Writes the buffer, and returns the end of what was written.
  std::uint64_t flush() {
    write_points(*file_, next_, buffer_);
    next_ += buffer_.size();
    buffer_.clear();
    return next_;
  }

 private:
  TemporaryFile* file_;
  std::uint64_t next_;
  std::vector<RawPoint> buffer_;
};

/// Calls `visit` for the points of all runs in ascending order of code; the order among equal codes is not defined.
template <class Visit>
void merge(const TemporaryFile& file, std::span<const Run> runs, std::uint64_t buffer_points, Visit visit) {
  struct Head {
    std::uint64_t code;
    RunReader* reader;
  };
  std::vector<RunReader> readers;
  readers.reserve(runs.size());
  for (const Run& run : runs) readers.emplace_back(file, run, buffer_points);
  std::vector<Head> heap;
  for (RunReader& reader : readers) heap.push_back({reader.point().code, &reader});
  std::sort(heap.begin(), heap.end(), [](const Head& a, const Head& b) { return a.code < b.code; });
  // The head is replaced in place and sifted down, which is half the work of popping and pushing.
  const auto sift_down = [&] {
    const Head moved = heap[0];
    std::size_t hole = 0;
    for (std::size_t child = 1; child < heap.size(); child = 2 * hole + 1) {
      if (child + 1 < heap.size() && heap[child + 1].code < heap[child].code) ++child;
      if (moved.code <= heap[child].code) break;
      heap[hole] = heap[child];
      hole = child;
    }
    heap[hole] = moved;
  };
  while (!heap.empty()) {
    Head& head = heap[0];
    visit(head.reader->point());
    if (head.reader->next()) {
      head.code = head.reader->point().code;
    } else {
      head = heap.back();
      heap.pop_back();
    }
    if (!heap.empty()) sift_down();
  }
}

std::uint64_t total(std::span<const Run> runs) {
  std::uint64_t result = 0;
  for (const Run& run : runs) result += run.last - run.first;
  return result;
}

}  // namespace

class SortedPoints::Impl {
 public:
  explicit Impl(const std::string& temporary_directory) : directory(temporary_directory), file(directory) {}

  /// Appends a point through a writer on the file that began at the file's beginning.
  void append(const RawPoint& point, RunWriter& writer) {
    if (size++ % kIndexStep == 0) index.push_back(point.code);
    writer.append(point);
  }

  std::string directory;
  TemporaryFile file;
  std::uint64_t size = 0;
  std::vector<std::uint64_t> index;  // the codes of points 0, kIndexStep, 2 kIndexStep...
  std::vector<CoveredPoint> covered;
};

SortedPoints::SortedPoints(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SortedPoints::SortedPoints(SortedPoints&&) noexcept = default;
SortedPoints& SortedPoints::operator=(SortedPoints&&) noexcept = default;
SortedPoints::~SortedPoints() = default;

std::uint64_t SortedPoints::size() const {
  return impl_->size;
}

const std::vector<CoveredPoint>& SortedPoints::covered() const {
  return impl_->covered;
}

void SortedPoints::read(std::uint64_t first, std::span<RawPoint> out) const {
  read_points(impl_->file, first, out);
}

void SortedPoints::write(std::uint64_t first, std::span<const RawPoint> points) {
  write_points(impl_->file, first, points);
}

std::vector<RawPoint> SortedPoints::cover(std::span<const RawPoint> vertices, const std::vector<bool>& of_lines) {
  const auto before = [](const CoveredPoint& a, const CoveredPoint& b) { return a.point.code < b.point.code; };
  std::vector<CoveredPoint> covered;
  std::vector<RawPoint> without_point;
  for (auto vertex = vertices.begin(); vertex != vertices.end();) {
    const std::uint64_t first = lower_bound(vertex->code);
    std::vector<RawPoint> points(std::min(kIndexStep, size() - first));
    if (points.empty()) {
      without_point.insert(without_point.end(), vertex, vertices.end());
      break;
    }
    read(first, points);
    for (RawPoint& p : points) {
      while (vertex != vertices.end() && vertex->code < p.code) without_point.push_back(*vertex++);
      if (vertex == vertices.end() || vertex->code != p.code) continue;
      if (!of_lines[p.source]) covered.push_back({p, vertex->source});
      p.z = vertex++->z;
    }
    write(first, points);
  }
  // What a vertex has covered before stays so.
  std::vector<CoveredPoint> all;
  std::set_union(impl_->covered.begin(), impl_->covered.end(), covered.begin(), covered.end(), std::back_inserter(all),
                 before);
  impl_->covered = std::move(all);
  return without_point;
}

std::uint64_t SortedPoints::lower_bound(std::uint64_t code) const {
  const std::vector<std::uint64_t>& index = impl_->index;
  const auto above = static_cast<std::uint64_t>(std::lower_bound(index.begin(), index.end(), code) - index.begin());
  if (above == 0) return 0;
  // Point (above - 1) * kIndexStep is below the code, and the next one in the index is not.
  const std::uint64_t first = (above - 1) * kIndexStep + 1;
  std::vector<RawPoint> between(std::min(kIndexStep - 1, impl_->size - first));
  read(first, between);
  const auto found = std::lower_bound(between.begin(), between.end(), code,
                                      [](const RawPoint& point, std::uint64_t value) { return point.code < value; });
  return first + static_cast<std::uint64_t>(found - between.begin());
}

SortedPoints SortedPoints::with(std::span<const RawPoint> more, std::uint16_t dropped) const {
  auto result = std::make_unique<Impl>(impl_->directory);
  result->covered = impl_->covered;
  RunWriter writer(result->file, 0, kLargestMergeBuffer);
  auto next = more.begin();
  const auto append_below = [&](std::uint64_t code) {
    for (; next != more.end() && next->code < code; ++next) result->append(*next, writer);
  };
  if (size() > 0) {
    RunReader reader(impl_->file, {0, size()}, kLargestMergeBuffer);
    do {
      const RawPoint& point = reader.point();
      if (point.level == dropped) continue;
      append_below(point.code);
      if (next != more.end() && next->code == point.code) ++next;
      result->append(point, writer);
    } while (reader.next());
  }
  append_below(~std::uint64_t{0});
  writer.flush();
  return SortedPoints(std::move(result));
}

class PointSorter::Impl {
 public:
  Impl(std::string directory, std::uint64_t memory_bytes)
      : directory_(std::move(directory)),
        memory_points_(std::max(memory_bytes / kPointBytes, 4 * kSmallestMergeBuffer)),
        chunk_points_(std::min(memory_points_ / kChunksInMemory, kLargestChunk)),
        file_(directory_) {}

  void add(std::span<const RawPoint> points) {
    while (!points.empty()) {
      if (chunks_.empty() || chunks_.back().size() == chunk_points_) open_chunk();
      std::vector<RawPoint>& chunk = chunks_.back();
      const std::size_t taken = std::min<std::size_t>(points.size(), chunk_points_ - chunk.size());
      chunk.insert(chunk.end(), points.begin(), points.begin() + static_cast<std::ptrdiff_t>(taken));
      points = points.subspan(taken);
    }
  }

  void renumber(std::vector<std::uint16_t> numbers) { numbers_ = std::move(numbers); }

  std::unique_ptr<SortedPoints::Impl> finish(std::span<const SourceRank> sources, Progress& progress,
                                             std::uint64_t& duplicates) {
    write_chunks();
    spare_ = {};  // the merge has its own buffers
    while (runs_.size() > fan_in()) merge_groups(progress);
    auto sorted = std::make_unique<SortedPoints::Impl>(directory_);
    merge_distinct(sources, progress, *sorted);
    duplicates = total(runs_) - sorted->size - sorted->covered.size();
    return sorted;
  }

 private:
  void open_chunk() {
    if ((chunks_.size() + 1) * chunk_points_ > memory_points_) write_chunks();
    // A small chunk grows as needed; its memory is kept from one batch of runs to the next.
    if (spare_.empty()) {
      chunks_.emplace_back();
    } else {
      chunks_.push_back(std::move(spare_.back()));
      spare_.pop_back();
    }
    chunks_.back().reserve(chunk_points_);
  }

  void write_chunks() {
    const std::uint64_t first_run = runs_.size();
    for (const std::vector<RawPoint>& chunk : chunks_) {
      runs_.push_back({end_, end_ + chunk.size()});
      end_ += chunk.size();
    }
    parallel_for(chunks_.size(), [&](std::size_t i) {
      std::sort(chunks_[i].begin(), chunks_[i].end(),
                [](const RawPoint& a, const RawPoint& b) { return a.code < b.code; });
      write_points(file_, runs_[first_run + i].first, chunks_[i]);
      chunks_[i].clear();
    });
    std::move(chunks_.begin(), chunks_.end(), std::back_inserter(spare_));
    chunks_.clear();
  }

  std::uint64_t fan_in() const { return std::max<std::uint64_t>(2, memory_points_ / kSmallestMergeBuffer - 1); }

  std::uint64_t merge_buffer(std::uint64_t runs) const {
    return std::clamp(memory_points_ / (runs + 1), kSmallestMergeBuffer, kLargestMergeBuffer);
  }

  /// Merges fan_in() runs at a time, so that the next pass has that many fewer.
  void merge_groups(Progress& progress) {
    TemporaryFile merged(directory_);
    std::vector<Run> longer;
    std::uint64_t end = 0;
    for (std::size_t i = 0; i < runs_.size(); i += fan_in()) {
      progress.throw_if_cancelled();
      const auto group = std::span(runs_).subspan(i, std::min<std::size_t>(fan_in(), runs_.size() - i));
      const std::uint64_t buffer = merge_buffer(group.size());
      RunWriter writer(merged, end, buffer);
      merge(file_, group, buffer, [&](const RawPoint& point) { writer.append(point); });
      longer.push_back({end, writer.flush()});
      end = longer.back().last;
    }
    file_ = std::move(merged);
    runs_ = std::move(longer);
  }

  void merge_distinct(std::span<const SourceRank> sources, Progress& progress, SortedPoints::Impl& sorted) {
    const auto preference = [&](const RawPoint& point) {
      const SourceRank& source = sources[point.source];
      return std::tuple(!source.line, source.spacing, !source.replaces, -std::int64_t{point.z}, source.order,
                        point.source);
    };
    const auto prefer = [&](std::optional<RawPoint>& best, const RawPoint& point) {
      if (!best || preference(point) < preference(*best)) best = point;
    };
    const std::uint64_t buffer = merge_buffer(runs_.size()), count = total(runs_);
    RunWriter writer(sorted.file, 0, buffer);
    std::optional<RawPoint> best, bare, ground;  // best points at a position: of all, off lines, of ground by itself
    std::uint64_t visited = 0;
    const auto append_best = [&] {
      if (!best) return;
      if (sources[best->source].line && bare) sorted.covered.push_back({*bare, best->source});
      if (!sources[best->source].ground && ground) best->source = ground->source;
      sorted.append(*best, writer);
    };
    merge(file_, runs_, buffer, [&](RawPoint point) {
      if (!numbers_.empty()) point.source = numbers_[point.source];
      if (visited++ % kProgressStep == 0) {
        progress.throw_if_cancelled();
        progress.report("sorting", static_cast<double>(visited) / static_cast<double>(count));
      }
      if (best && best->code != point.code) {
        append_best();
        best.reset();
        bare.reset();
        ground.reset();
      }
      prefer(best, point);
      if (!sources[point.source].line) prefer(bare, point);
      if (sources[point.source].ground) prefer(ground, point);
    });
    append_best();
    writer.flush();
  }

  std::string directory_;
  std::uint64_t memory_points_;
  std::uint64_t chunk_points_;
  TemporaryFile file_;
  std::uint64_t end_ = 0;  // the length of the file, in points
  std::vector<Run> runs_;
  std::vector<std::vector<RawPoint>> chunks_;  // all but the last one full
  std::vector<std::vector<RawPoint>> spare_;   // empty, with memory
  std::vector<std::uint16_t> numbers_;         // a source of number s has numbers_[s] now; may be empty
};

PointSorter::PointSorter(std::string directory, std::uint64_t memory_bytes)
    : impl_(std::make_unique<Impl>(std::move(directory), memory_bytes)) {}
PointSorter::~PointSorter() = default;

void PointSorter::add(const RawPoint& point) {
  impl_->add(std::span(&point, 1));
}
void PointSorter::add(std::span<const RawPoint> points) {
  impl_->add(points);
}

void PointSorter::renumber(std::vector<std::uint16_t> numbers) {
  impl_->renumber(std::move(numbers));
}

SortedPoints PointSorter::finish(std::span<const SourceRank> sources, Progress& progress, std::uint64_t* duplicates) {
  std::uint64_t dropped = 0;
  SortedPoints result(impl_->finish(sources, progress, dropped));
  if (duplicates) *duplicates = dropped;
  return result;
}

}  // namespace itin
