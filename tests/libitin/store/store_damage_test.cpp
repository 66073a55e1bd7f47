// Every kind of damage gives a typed error that names the file, or, in bytes nobody uses, the unchanged answer.
#include <algorithm>
#include <filesystem>
#include <gmock/gmock.h>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/store.hpp>

#include "libitin/store/random_points.hpp"
#include "store/codec/point_index.hpp"
#include "store/codec/store_format.hpp"
#include "support/forged_rows.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// All that can be asked of a store.
struct Contents {
  std::string crs;
  std::vector<GridPoint> points;
  std::vector<std::uint16_t> sources;
  std::vector<std::pair<std::int32_t, std::int32_t>> certificates;
  std::vector<Segment> segments;
  friend bool operator==(const Contents&, const Contents&) = default;
};

Contents read_all(const std::string& path) {
  const Store store(path);
  Contents all;
  all.crs = store.metadata().crs_wkt;
  std::vector<Leaf> leaves;
  store.points().leaves({}, store.points().bounds(), leaves);
  for (const Leaf& leaf : leaves) {
    const auto block = store.points().block(leaf);
    all.points.insert(all.points.end(), block->points.begin(), block->points.end());
    for (std::size_t k = 0; k < block->points.size(); ++k) all.sources.push_back(block->sources[k]);
    all.certificates.emplace_back(leaf.lo, leaf.hi);
  }
  store.points().segments(store.points().bounds(), all.segments);
  return all;
}

class StoreDamage : public testing::Test {
 protected:
  void SetUp() override {
    test::random_store(seed_, 1500, 2).write(path_);
    sound_ = test::read_bytes(path_);
    expected_ = read_all(path_);
  }

  void expect_error_or_same() {
    try {
      EXPECT_EQ(read_all(path_), expected_);
    } catch (const FileError& e) {
      EXPECT_THAT(e.what(), StartsWith(path_ + ": "));
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    }
  }
  void execute(const std::string& sql) { test::execute_sql(path_, sql); }
  std::vector<std::string> damaged_places() {
    NoProgress progress;
    std::vector<std::string> places;
    for (const Damage& d : check(Store(path_), progress)) places.push_back(d.place);
    return places;
  }
  template <typename E>
  void expect_message(const std::string& what) {
    try {
      read_all(path_);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const E& e) {
      EXPECT_THAT(e.what(), HasSubstr(what));
      EXPECT_THAT(e.what(), StartsWith(path_ + ": "));
    }
  }

  const std::uint64_t seed_ = test::seed();
  const test::TemporaryDirectory directory_;
  const std::string path_ = directory_.file("damaged.itin");
  std::string sound_;
  Contents expected_;
};

TEST_F(StoreDamage, AnyByte) {
  std::mt19937_64 random(seed_);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < 100; ++i) places.push_back(i);
  for (int i = 0; i < 1500; ++i) places.push_back(random() % sound_.size());
  for (std::size_t page = 0; page < sound_.size(); page += 16384) {
    for (std::size_t i = 0; i < 24; ++i) places.push_back(page + i);  // b-tree page headers and cell pointers
  }
  for (const std::size_t place : places) {
    SCOPED_TRACE(place);
    std::string bytes = sound_;
    bytes[place] = static_cast<char>(bytes[place] ^ (1 + random() % 255));
    test::write_bytes(path_, bytes);
    expect_error_or_same();
  }
}

TEST_F(StoreDamage, AnyTruncation) {
  std::mt19937_64 random(seed_);
  std::vector<std::size_t> sizes = {0, 1, 15, 16, 99, 100, 512, 16383, 16384, 16385, 32768, sound_.size() - 1};
  for (int i = 0; i < 50; ++i) sizes.push_back(random() % sound_.size());
  for (const std::size_t size : sizes) {
    test::write_bytes(path_, sound_.substr(0, size));
    EXPECT_THROW(Store{path_}, FileError) << size;
  }
  test::write_bytes(path_, sound_ + "more");
  EXPECT_THROW(Store{path_}, CorruptStore);
}

TEST_F(StoreDamage, WrongKindsOfFile) {
  std::filesystem::remove(path_);
  expect_message<FileError>("there is no such store; name one that itin import made");
  std::filesystem::create_directory(path_);
  expect_message<FileError>("is a directory");
  std::filesystem::remove(path_);
  test::write_bytes(path_, "");
  expect_message<StoreFormatError>("not an itin store");
  test::write_bytes(path_, "x,y,z\n1,2,3\n");
  expect_message<StoreFormatError>("not an itin store");
  std::filesystem::remove(path_);
  execute("CREATE TABLE t(a); INSERT INTO t VALUES(1)");
  expect_message<StoreFormatError>("another program");
}

TEST_F(StoreDamage, NewerFormat) {
  const std::string newer = std::to_string(format::kVersion + 1);
  execute("PRAGMA user_version=" + newer);
  expect_message<StoreFormatError>("store format " + newer);
}

TEST_F(StoreDamage, OlderFormat) {
  execute("PRAGMA user_version=9");
  expect_message<StoreFormatError>("has store format 9, which this itin reads no more; import its sources again");
}

TEST_F(StoreDamage, ForeignContentsUnderOurApplicationId) {
  std::filesystem::remove(path_);
  execute("PRAGMA application_id=0x4954494e; PRAGMA user_version=11; CREATE TABLE t(a)");
  expect_message<CorruptStore>("schema");
}

TEST_F(StoreDamage, CheckNamesEveryDamagedBlock) {
  const std::string two = "(SELECT key FROM block ORDER BY key LIMIT 2 OFFSET 1)";
  execute(
      "UPDATE block SET data = CASE substr(data, 1, 1) WHEN x'00' THEN x'01' ELSE x'00' END || substr(data, 2) WHERE "
      "key IN " +
      two);
  const auto places = damaged_places();
  EXPECT_EQ(places.size(), 2u);
  for (const auto& place : places) EXPECT_THAT(place, StartsWith("block 0/"));
  expect_message<CorruptStore>("block 0/");
}

TEST_F(StoreDamage, CheckFindsMissingAndSwappedAndStrayRows) {
  execute("DELETE FROM block WHERE key = (SELECT max(key) FROM block)");
  EXPECT_EQ(damaged_places().size(), 1u);
  test::write_bytes(path_, sound_);
  execute("INSERT INTO block SELECT 5, data FROM block LIMIT 1");
  EXPECT_EQ(damaged_places(), std::vector<std::string>{"block 0/0000000000005"});
  test::write_bytes(path_, sound_);
  execute(
      "UPDATE block SET data = (SELECT data FROM block ORDER BY key LIMIT 1) WHERE key = "
      "(SELECT key FROM block ORDER BY key LIMIT 1 OFFSET 1)");
  EXPECT_EQ(damaged_places().size(), 1u);
  test::write_bytes(path_, sound_);
  execute("UPDATE directory SET data = substr(data, 1, length(data) - 1) WHERE key < 4096");
  EXPECT_THAT(damaged_places(), testing::Each(StartsWith("directory")));
}

TEST_F(StoreDamage, MetadataChangedByHand) {
  execute("UPDATE metadata SET value = replace(value, 'test', 'tset')");
  expect_message<CorruptStore>("metadata");
}

}  // namespace
}  // namespace itin
