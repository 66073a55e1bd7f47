// The imports that a store keeps beside its surface: written, read, and found damaged.
#include "store/set_aside.hpp"

#include <gmock/gmock.h>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/store.hpp>

#include "libitin/store/random_points.hpp"
#include "store/store_file.hpp"
#include "store/store_writer.hpp"
#include "support/forged_rows.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

class SetAside : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937 random(test::seed());
    const auto within = [&](std::uint32_t n) {
      return static_cast<std::int32_t>(random() % (2 * n)) - static_cast<std::int32_t>(n);
    };
    for (int i = 0; i < 6000; ++i) {
      const GridPoint p{within(1U << 29), within(1U << 29), within(1U << 20)};
      lines_.imported.push_back({p, {p.x / 2, within(1000), within(1U << 30)}, static_cast<std::uint16_t>(i % 3)});
      if (i % 3 == 0) lines_.made.push_back({p.x, p.y, within(1U << 29), within(1U << 29)});
    }
    std::sort(lines_.imported.begin(), lines_.imported.end());
    std::sort(lines_.made.begin(), lines_.made.end());
    const test::GivenStore given = test::random_store(1, 600);
    StoreWriter writer(path_, "", given.grid, given.tolerances);
    given.add_leaves(writer);
    writer.add_segments(given.segments);
    writer.set_aside(Cell{0, 30}, std::span(&point_, 1), std::span(&source_, 1));
    writer.set_aside(2, lines_);
    writer.count_set_aside({1, 2, 3, 4});
    writer.commit(std::vector<SourceInfo>(3));
  }
  void execute(const std::string& sql) { test::execute_sql(path_, sql); }
  std::vector<std::string> damaged_places() {
    NoProgress progress;
    std::vector<std::string> places;
    for (const Damage& d : check(Store(path_), progress)) places.push_back(d.place);
    return places;
  }

  const test::TemporaryDirectory directory_;
  const std::string path_ = directory_.file("s.itin");
  const GridPoint point_{12345, -77, 9};
  const std::uint16_t source_ = 2;
  SetAsideLines lines_;
};

TEST_F(SetAside, IsReadAsItWasWritten) {
  EXPECT_THAT(damaged_places(), testing::IsEmpty());
  const Store store(path_);
  const SetAsideList list = set_aside_list(file_of(store).rows());
  EXPECT_EQ(list.point_blocks, 1u);
  EXPECT_EQ(list.blocks_of(1), 0u);
  EXPECT_EQ(list.blocks_of(2), 2u);
  EXPECT_EQ(list.blocks_of(3), 0u);
  EXPECT_EQ(list.counts.crossings, 4u);
  EXPECT_EQ(set_aside_points(file_of(store).rows(), 0).points, std::vector<GridPoint>{point_});
  EXPECT_EQ(test::each_of(set_aside_points(file_of(store).rows(), 0).sources), std::vector<std::uint16_t>{source_});
  SetAsideLines read;
  for (std::uint32_t i = 0; i < 2; ++i) {
    const SetAsideLines some = set_aside_lines(file_of(store).rows(), 2, i);
    read.imported.insert(read.imported.end(), some.imported.begin(), some.imported.end());
    read.made.insert(read.made.end(), some.made.begin(), some.made.end());
  }
  EXPECT_EQ(read.imported, lines_.imported);
  EXPECT_EQ(read.made, lines_.made);
}

TEST_F(SetAside, CheckFindsWhatIsDamagedOrMissing) {
  const std::string points = std::to_string(std::uint64_t{2045} << 52),
                    lines = std::to_string((std::uint64_t{2045} << 52) + (std::uint64_t{2} << 32) + 1);
  execute("UPDATE block SET data = data || x'00' WHERE key = " + points);
  EXPECT_EQ(damaged_places(), std::vector<std::string>{"block 2045/0000000000000"});
  execute("DELETE FROM block WHERE key = " + lines);
  EXPECT_EQ(damaged_places(), (std::vector<std::string>{"block 2045/0000000000000", "block 2045/0000200000001"}));
  execute("DELETE FROM directory WHERE key = " + points);
  EXPECT_EQ(damaged_places(), std::vector<std::string>{"directory 2045/0000000000000"});
}

}  // namespace
}  // namespace itin
