// Files and folders that go at the end of a scope, and those that an early end of the program leaves.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <stdexcept>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include <itin/unfinished.hpp>

#include "support/temporary_directory.hpp"

namespace itin::test {
namespace {

namespace fs = std::filesystem;
using Kind = Unfinished::Kind;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

class UnfinishedTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }
  void write(const std::string& name) const { std::ofstream(path(name)) << name; }
  void make_folder(const std::string& name) const { fs::create_directory(path(name)); }
  std::vector<std::string> left() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(directory_.path()))
      names.push_back(fs::relative(entry.path(), directory_.path()).string());
    return names;
  }

 private:
  TemporaryDirectory directory_;
};

TEST_F(UnfinishedTest, GoesAtTheEndOfItsLife) {
  {
    const Unfinished file(path("a")), folder(path("b"), Kind::folder), never_made(path("c"));
    write("a"), write("a-journal"), make_folder("b"), write("b/in");
  }
  EXPECT_THAT(left(), IsEmpty());
}

TEST_F(UnfinishedTest, OnlyEmptyFoldersOfItsKindGo) {
  make_folder("empty"), make_folder("full"), write("full/in");
  { const Unfinished empty(path("empty"), Kind::folder_if_empty), full(path("full"), Kind::folder_if_empty); }
  EXPECT_THAT(left(), UnorderedElementsAre("full", "full/in"));
}

TEST_F(UnfinishedTest, StaysOnceFinished) {
  {
    Unfinished file(path("a"));
    write("a");
    file.finish([&] { fs::rename(file.path(), path("b")); });
    write("a");  // somebody else's
  }
  EXPECT_THAT(left(), UnorderedElementsAre("a", "b"));
}

TEST_F(UnfinishedTest, GoesWhereItCannotBePutInPlace) {
  {
    Unfinished file(path("a"));
    write("a");
    EXPECT_THROW(file.finish([] { throw std::runtime_error("no"); }), std::runtime_error);
    EXPECT_THAT(left(), UnorderedElementsAre("a"));
  }
  EXPECT_THAT(left(), IsEmpty());
}

TEST_F(UnfinishedTest, AllOfItGoesWhereTheProgramIsEnded) {
  const auto end = [&] {
    make_folder("new"), make_folder("working"), write("working/in"), write("done"), write("a"), write("new/b");
    const Unfinished folder(path("new"), Kind::folder_if_empty), working(path("working"), Kind::folder);
    const Unfinished a(path("a")), b(path("new/b"));
    Unfinished done(path("done"));
    done.finish([] {});
    // However busily another thread begins and finishes things, none is half done at the end.
    std::thread([&] {
      for (int i = 0;; ++i) {
        Unfinished next(path("next" + std::to_string(i)));
        if (i % 2 == 0) next.finish([] {});
      }
    }).detach();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    remove_unfinished();
    _exit(7);
  };
  EXPECT_EXIT(end(), ::testing::ExitedWithCode(7), "");
  EXPECT_THAT(left(), UnorderedElementsAre("done"));
}

}  // namespace
}  // namespace itin::test
