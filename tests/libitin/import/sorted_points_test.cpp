// PointSorter against std::stable_sort and a plain reading of its rule for duplicates.
#include "pyramid/points/sorted_points.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <random>
#include <sys/resource.h>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>

#include "support/seed.hpp"

namespace itin {
namespace {

constexpr std::uint64_t kTiny = 1 << 16;  // many runs, and several passes to merge them

bool same(const RawPoint& a, const RawPoint& b) {
  return a.code == b.code && a.z == b.z && a.source == b.source && a.level == b.level;
}

bool same(const std::vector<RawPoint>& a, const std::vector<RawPoint>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const RawPoint& p, const RawPoint& q) { return same(p, q); });
}

std::vector<RawPoint> random_points(std::size_t count, std::uint64_t codes, std::mt19937_64& random) {
  std::vector<RawPoint> points(count);
  for (RawPoint& p : points) {
    p = {random() % codes * 0x1234567, static_cast<std::int32_t>(random() % 5) - 2,
         static_cast<std::uint16_t>(random() % 3), 0};
  }
  return points;
}

/// The rule word for word: finest spacing, then those that replace, then highest, then lowest source number; ground
/// stays ground.
std::vector<RawPoint> expected(std::vector<RawPoint> points, const std::vector<SourceRank>& sources) {
  const auto keep_order_by = [&](auto before) { std::stable_sort(points.begin(), points.end(), before); };
  keep_order_by([](const RawPoint& a, const RawPoint& b) { return a.source < b.source; });
  keep_order_by([](const RawPoint& a, const RawPoint& b) { return a.z > b.z; });
  keep_order_by(
      [&](const RawPoint& a, const RawPoint& b) { return sources[a.source].replaces > sources[b.source].replaces; });
  keep_order_by(
      [&](const RawPoint& a, const RawPoint& b) { return sources[a.source].spacing < sources[b.source].spacing; });
  keep_order_by([](const RawPoint& a, const RawPoint& b) { return a.code < b.code; });
  for (std::size_t first = 0, i = 1; i < points.size(); ++i) {
    if (points[i].code != points[first].code) first = i;
    if (!sources[points[first].source].ground && sources[points[i].source].ground)
      points[first].source = points[i].source;
  }
  points.erase(
      std::unique(points.begin(), points.end(), [](const RawPoint& a, const RawPoint& b) { return a.code == b.code; }),
      points.end());
  return points;
}

SortedPoints sort(const std::vector<RawPoint>& points, const std::vector<SourceRank>& sources, std::uint64_t memory,
                  std::uint64_t* duplicates = nullptr) {
  PointSorter sorter(::testing::TempDir(), memory);
  sorter.add(points);
  NoProgress progress;
  return sorter.finish(sources, progress, duplicates);
}

std::vector<RawPoint> all_of(const SortedPoints& sorted) {
  std::vector<RawPoint> points(sorted.size());
  sorted.read(0, points);
  return points;
}

TEST(PointSorter, AgreesWithStableSortWhateverTheMemory) {
  std::mt19937_64 random(test::seed());
  const std::vector<SourceRank> sources{{50}, {5, false}, {50, false, false, 0, true}};
  for (const std::size_t count : {0, 1, 2, 1023, 1024, 1025, 5000, 300000}) {
    for (const std::uint64_t codes : {std::uint64_t{3}, std::uint64_t{20000}, std::uint64_t{1} << 36}) {
      const std::vector<RawPoint> points = random_points(count, codes, random);
      const std::vector<RawPoint> truth = expected(points, sources);
      for (const std::uint64_t memory : {std::uint64_t{0}, kTiny, std::uint64_t{1} << 20, std::uint64_t{1} << 30}) {
        std::uint64_t duplicates = 0;
        const SortedPoints sorted = sort(points, sources, memory, &duplicates);
        EXPECT_TRUE(same(all_of(sorted), truth)) << count << " points, " << codes << " codes, " << memory << " bytes";
        EXPECT_EQ(duplicates, count - truth.size());
      }
    }
  }
}

TEST(PointSorter, DependsNeitherOnOrderNorOnThreads) {
  std::mt19937_64 random(test::seed());
  const std::vector<SourceRank> sources{{2}, {1}, {1, false}};
  std::vector<RawPoint> points = random_points(100000, 30000, random);
  const std::vector<RawPoint> first = all_of(sort(points, sources, kTiny));
  for (const int threads : {1, 2, 0}) {
    std::shuffle(points.begin(), points.end(), random);
    set_thread_count(threads);
    PointSorter sorter(::testing::TempDir(), kTiny);
    for (const RawPoint& point : points) sorter.add(point);
    NoProgress progress;
    EXPECT_TRUE(same(all_of(sorter.finish(sources, progress)), first)) << threads << " threads";
  }
  set_thread_count(0);
}

TEST(PointSorter, PrefersFinerThenHigherThenEarlierSources) {
  const std::vector<SourceRank> sources{{50}, {2}, {2}};
  const auto winner = [&](const std::vector<RawPoint>& points) { return all_of(sort(points, sources, kTiny)).at(0); };
  EXPECT_TRUE(same(winner({{7, 900, 0}, {7, 10, 1}}), {7, 10, 1}));
  EXPECT_TRUE(same(winner({{7, 10, 1}, {7, 11, 2}}), {7, 11, 2}));
  EXPECT_TRUE(same(winner({{7, 10, 2}, {7, 10, 1}}), {7, 10, 1}));
}

TEST(PointSorter, PrefersSourcesThatReplaceAmongEquallyFineOnes) {
  const std::vector<SourceRank> sources{{50}, {50, true, false, 1, true}, {2}};
  const auto winner = [&](const std::vector<RawPoint>& points) { return all_of(sort(points, sources, kTiny)).at(0); };
  EXPECT_TRUE(same(winner({{7, 900, 0}, {7, 10, 1}}), {7, 10, 1}));
  EXPECT_TRUE(same(winner({{7, 900, 1}, {7, 10, 2}}), {7, 10, 2}));
}

TEST(PointSorter, GroundStaysGround) {
  const std::vector<SourceRank> sources{{50}, {0, false}, {2}};
  const auto winner = [&](const std::vector<RawPoint>& points) { return all_of(sort(points, sources, kTiny)).at(0); };
  EXPECT_TRUE(same(winner({{7, 10, 0}, {7, 12, 1}}), {7, 12, 0}));
  EXPECT_TRUE(same(winner({{7, 12, 1}, {7, 10, 0}, {7, 9, 2}}), {7, 12, 2}));
  EXPECT_TRUE(same(winner({{7, 12, 1}, {8, 10, 0}}), {7, 12, 1}));
}

TEST(PointSorter, StopsWhenCancelled) {
  class Cancelling final : public Progress {
   public:
    void report(std::string_view, double) override {}
    bool cancelled() const override { return true; }
  } progress;
  PointSorter sorter(::testing::TempDir(), kTiny);
  sorter.add(RawPoint{});
  const std::vector<SourceRank> sources{{1}};
  EXPECT_THROW(sorter.finish(sources, progress), Cancelled);
}

TEST(PointSorter, LeavesNoFileBehind) {
  const std::filesystem::path directory = std::filesystem::path(::testing::TempDir()) / "itin-sorter";
  std::filesystem::create_directory(directory);
  PointSorter sorter(directory, kTiny);
  for (std::uint64_t i = 0; i < 10000; ++i) sorter.add({i, 0, 0});
  EXPECT_TRUE(std::filesystem::is_empty(directory));
  std::filesystem::remove(directory);
}

TEST(PointSorter, NamesTheDirectoryItCannotWriteTo) {
  try {
    PointSorter sorter("/nonexistent/place", kTiny);
    FAIL() << "no exception";
  } catch (const FileError& error) {
    EXPECT_EQ(error.path(), "/nonexistent/place");
    EXPECT_STREQ(error.what(), "/nonexistent/place: cannot create a temporary file: No such file or directory");
  }
}

TEST(PointSorter, SaysThatTheDiskIsFull) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1 << 20, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    PointSorter sorter("/tmp", kTiny);
    for (std::uint64_t i = 0; i < 200000; ++i) sorter.add({i, 0, 0});
  } catch (const FileError& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, handler);
  EXPECT_EQ(message,
            "/tmp: cannot write a temporary file: File too large; free some space there, about 32 bytes per point, and "
            "try again");
}

TEST(SortedPoints, FindsLowerBoundsAsASearchThroughAllDoes) {
  std::mt19937_64 random(test::seed());
  for (const std::size_t count : {0, 1, 1024, 1025, 2048, 9999}) {
    const SortedPoints sorted = sort(random_points(count, 1 << 20, random), {{1}, {1}, {1}}, kTiny);
    const std::vector<RawPoint> all = all_of(sorted);
    const auto check = [&](std::uint64_t code) {
      const auto below = std::count_if(all.begin(), all.end(), [&](const RawPoint& p) { return p.code < code; });
      EXPECT_EQ(sorted.lower_bound(code), static_cast<std::uint64_t>(below)) << code;
    };
    check(0);
    check(~std::uint64_t{0});
    for (std::size_t i = 0; i < all.size(); i += 1 + random() % 50) {
      for (const std::uint64_t offset : {0, 1}) check(all[i].code + offset);
    }
  }
}

TEST(SortedPoints, KeepsWhatIsWritten) {
  std::vector<RawPoint> points(5000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].code = i;
  SortedPoints sorted = sort(points, {{1}}, kTiny);
  for (std::size_t i = 1000; i < 3000; ++i) points[i].level = static_cast<std::uint16_t>(i % 7);
  sorted.write(1000, std::span(points).subspan(1000, 2000));
  EXPECT_TRUE(same(all_of(sorted), points));
}

}  // namespace
}  // namespace itin
