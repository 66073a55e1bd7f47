// Law 6: whatever happens to a writer, the old store stays.
#include "store/store_writer.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/store.hpp>

#include "libitin/store/random_points.hpp"
#include "store/file/store_rows.hpp"

namespace itin {
namespace {

namespace fs = std::filesystem;

class StoreWriterTest : public testing::Test {
 protected:
  void SetUp() override {
    old_.write(path_);
    old_bytes_ = test::read_bytes(path_);
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory_.path()), {}));
  }
  void expect_old_store() const {
    EXPECT_EQ(test::read_bytes(path_), old_bytes_);
    NoProgress progress;
    EXPECT_TRUE(check(Store(path_), progress).empty());
  }
  void expect_new_store_can_be_written() const {
    new_.write(path_);
    EXPECT_NE(test::read_bytes(path_), old_bytes_);
    NoProgress progress;
    EXPECT_TRUE(check(Store(path_), progress).empty());
    EXPECT_EQ(files(), 1u);
  }
  static void add_all(StoreWriter& writer, const test::GivenStore& given) {
    given.add_leaves(writer);
    writer.add_segments(given.segments);
  }

  const test::TemporaryDirectory directory_;
  const std::string path_ = directory_.file("old.itin");
  const test::GivenStore old_ = test::random_store(1, 600), new_ = test::random_store(2, 60000);
  std::string old_bytes_;
};

TEST_F(StoreWriterTest, AbandonedWriterLeavesNothing) {
  {
    StoreWriter writer(path_, "", new_.grid, new_.tolerances);
    add_all(writer, new_);
  }
  expect_old_store();
  EXPECT_EQ(files(), 1u);
}

TEST_F(StoreWriterTest, SecondWriterOfOneTargetIsRefused) {
  StoreWriter first(path_, "", new_.grid, new_.tolerances);
  EXPECT_THROW(StoreWriter(path_, "", new_.grid, new_.tolerances), FileError);
  add_all(first, new_);
  first.commit(std::vector<SourceInfo>(3));
  EXPECT_NE(test::read_bytes(path_), old_bytes_);
  StoreWriter third(path_, "", new_.grid, new_.tolerances);
}

TEST_F(StoreWriterTest, FullDisk) {
  // In a child, for the limit would stay. The limit falls at various places of the new file.
  for (const rlim_t limit : {rlim_t{0}, rlim_t{1000}, rlim_t{40000}, rlim_t{100000}}) {
    const pid_t child = fork();
    if (child == 0) {
      std::signal(SIGXFSZ, SIG_IGN);
      const rlimit size{limit, limit};
      setrlimit(RLIMIT_FSIZE, &size);
      try {
        new_.write(path_);
      } catch (const FileError&) {
        _exit(7);
      } catch (...) {
        _exit(8);
      }
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 7);
    expect_old_store();
    EXPECT_EQ(files(), 1u);
  }
  expect_new_store_can_be_written();
}

TEST_F(StoreWriterTest, KilledWriter) {
  for (const std::size_t leaves : {std::size_t{0}, std::size_t{10}, new_.leaves.size()}) {
    const pid_t child = fork();
    if (child == 0) {
      StoreWriter writer(path_, "", new_.grid, new_.tolerances);
      new_.add_leaves(writer, leaves);
      std::raise(SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    expect_old_store();
  }
  expect_new_store_can_be_written();
}

TEST_F(StoreWriterTest, PlacesThatCannotBeWritten) {
  EXPECT_THROW(new_.write(directory_.file("no/such/place.itin")), FileError);
  EXPECT_THROW(new_.write(directory_.path()), FileError);
  fs::create_directory(directory_.file("d.itin.writing"));
  EXPECT_THROW(new_.write(directory_.file("d.itin")), FileError);
}

TEST_F(StoreWriterTest, LinkAndModeOfTheTargetStay) {
  const std::string link = directory_.file("link.itin");
  fs::create_symlink("old.itin", link);
  fs::permissions(path_, fs::perms::owner_read | fs::perms::owner_write);
  new_.write(link);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_NE(test::read_bytes(path_), old_bytes_);
  EXPECT_EQ(fs::status(path_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(StoreWriterTest, OpenStoreNeverMixesOldAndNew) {
  const Store store(path_, {0});
  const StoreRows rows(path_);
  new_.write(path_);
  NoProgress progress;
  EXPECT_TRUE(check(store, progress).empty());  // on the connection that it has
  rows.for_each_key(BlobKind::Block, [&](std::uint64_t key) {
    EXPECT_THROW(rows.read(BlobKind::Block, key, [](auto) {}),
                 FileError);  // a second connection would see the new file
  });
}

TEST_F(StoreWriterTest, EmptyStore) {
  const std::string path = directory_.file("empty.itin");
  StoreWriter(path, "", Grid{}, {0}).commit({});
  const Store store(path);
  EXPECT_EQ(store.metadata().vertices, 0u);
  EXPECT_FALSE(store.certified_error(0, {-1e9, -1e9, 1e9, 1e9}).has_value());
}

TEST_F(StoreWriterTest, LeavesOutOfOrderAreRefused) {
  StoreWriter writer(directory_.file("x.itin"), "", Grid{}, {0, 1});
  const GridPoint p{0, 0, 0};
  const std::uint16_t source = 0;
  const std::span<const GridPoint> points(&p, 1);
  const std::span<const std::uint16_t> sources(&source, 1);
  EXPECT_THROW(writer.set_fine_levels(0), std::invalid_argument);
  EXPECT_THROW(writer.set_fine_levels(3), std::invalid_argument);
  EXPECT_THROW(writer.set_right_triangle_levels(-1), std::invalid_argument);
  EXPECT_THROW(writer.set_right_triangle_levels(2), std::invalid_argument);
  EXPECT_THROW(writer.add_ground({morton(0, 0), 5}, points, sources, {}), std::invalid_argument);
  writer.add_leaf(1, {morton(0, 0), 5}, points, sources, 0, 0);
  EXPECT_THROW(writer.set_fine_levels(1), std::invalid_argument);
  EXPECT_THROW(writer.add_leaf(1, {morton(0, 0), 4}, {}, {}, 0, 0), std::invalid_argument);
  EXPECT_THROW(writer.add_ground({morton(64, 64), 4}, {}, {}, {}), std::invalid_argument);
  EXPECT_THROW(writer.add_leaf(0, {morton(64, 64), 4}, {}, {}, 0, 0), std::invalid_argument);
  EXPECT_THROW(writer.add_leaf(1, {morton(64, 64), 3}, {}, {}, 0, 0), std::invalid_argument);
  EXPECT_THROW(writer.add_leaf(2, {morton(64, 64), 4}, {}, {}, 0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace itin
