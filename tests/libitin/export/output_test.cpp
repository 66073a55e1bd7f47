// Rules that all formats share: names, replacing, and leaving nothing behind.
#include <csignal>
#include <filesystem>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include <itin/error.hpp>

#include "export/buffered_file.hpp"
#include "export/pending_file.hpp"
#include "libitin/export/export_fixture.hpp"

namespace itin::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kNames[] = {"a.ply", "a.obj", "a.glb", "a.gpkg", "a.geojson", "a.2dm"};

class CancelAtOnce final : public Progress {
 public:
  void report(std::string_view, double) override {}
  bool cancelled() const override { return true; }
};

class OutputTest : public ExportTest {
 protected:
  template <typename Call>
  static std::string message(const Call& call) {
    try {
      call();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(OutputTest, LeavesTheFileAndNothingElse) {
  for (const char* name : kNames) {
    const TemporaryDirectory directory;
    export_tin(tin_, directory.file(name), options_, progress_);
    EXPECT_THAT(directory.names(), ElementsAre(name));
  }
}

TEST_F(OutputTest, EndingsMayBeCapitals) {
  EXPECT_NO_THROW(exported("A.PLY"));
}

TEST_F(OutputTest, UnknownEndingsAreNamed) {
  for (const char* name : {"a.dwg", "a", "a.ply.zip"}) {
    EXPECT_THROW(exported(name), InputError);
    EXPECT_THROW(require_tin_output(directory_.file(name), true), InputError);
  }
  EXPECT_THAT(message([&] { exported("a.dwg"); }), HasSubstr(".ply, .obj, .glb, .gpkg, .geojson or .2dm"));
  EXPECT_THAT(directory_.names(), IsEmpty());
}

TEST_F(OutputTest, ExistingFilesAreReplacedOnlyWhenAsked) {
  for (const char* name : kNames) {
    const std::string path = directory_.file(name);
    options_.overwrite = false;
    std::ofstream(path) << "mine";
    EXPECT_THROW(exported(name), FileError) << name;
    EXPECT_THROW(require_tin_output(path, false), FileError) << name;
    EXPECT_EQ(bytes_of(path), "mine");
    options_.overwrite = true;
    EXPECT_NO_THROW(require_tin_output(path, true));
    exported(name);
    EXPECT_GT(bytes_of(path).size(), 1000u);
  }
  EXPECT_EQ(directory_.names().size(), std::size(kNames));
}

TEST_F(OutputTest, MissingFoldersAndFoldersAreNamed) {
  std::filesystem::create_directory(directory_.file("folder.ply"));
  EXPECT_THAT(message([&] { exported("folder.ply"); }), HasSubstr("is a folder"));
  for (const char* name : kNames)
    EXPECT_THAT(message([&] { exported("none/" + std::string(name)); }), HasSubstr("there is no folder"));
}

TEST_F(OutputTest, CancellingLeavesNothing) {
  // Enough steps that every format looks for cancellation.
  std::vector<GridPoint> points;
  for (std::int32_t y = 0; y < 200; ++y)
    for (std::int32_t x = 0; x < 200; ++x) points.push_back({x, y, 0});
  tin_ = delaunay_tin({{0, 0}, 1}, points, std::vector<std::uint16_t>(points.size(), 0),
                      [](const auto&, const auto&, const auto&) { return true; });
  CancelAtOnce cancel;
  for (const char* name : kNames)
    EXPECT_THROW(export_tin(tin_, directory_.file(name), options_, cancel), Cancelled) << name;
  EXPECT_THAT(directory_.names(), IsEmpty());
}

/// Stands for a full disk: writes beyond the limit fail.
class LimitedFileSize {
 public:
  explicit LimitedFileSize(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~LimitedFileSize() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST_F(OutputTest, FullDiskIsAFileErrorAndLeavesNothing) {
  for (const char* name : kNames) {
    const LimitedFileSize limit(5000);
    const std::string text = message([&] { exported(name); });
    EXPECT_THAT(text, HasSubstr(directory_.file(name))) << name;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
  EXPECT_THAT(directory_.names(), IsEmpty());
}

TEST_F(OutputTest, NeverWritesThroughSomeoneElsesTemporaryFile) {
  const PendingFile output(directory_.file("a.ply"), false);
  std::ofstream(output.temporary_path()) << "theirs";
  EXPECT_THROW(BufferedFile{output}, FileError);
}

}  // namespace
}  // namespace itin::test
