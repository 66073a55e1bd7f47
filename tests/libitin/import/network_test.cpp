// A program that uses the libraries gets the same refusal, unless it allows requests before anything else.
#include <gmock/gmock.h>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/network.hpp>

#include "support/listener.hpp"
#include "support/temporary_directory.hpp"

namespace itin {

namespace {

TEST(Network, IsNotAskedByTheLibrariesEither) {
  test::Listener server;
  const test::TemporaryDirectory directory;
  ImportOptions options;
  options.sources = {server.address() + "/a.tif"};
  NoProgress progress;
  try {
    import_terrain(directory.file("new.itin"), options, progress);
    FAIL() << "should not be read";
  } catch (const FileError& error) {
    EXPECT_EQ(error.path(), options.sources.front());
    EXPECT_THAT(error.what(), testing::HasSubstr("needs the network for " + options.sources.front()));
  }
  EXPECT_EQ(server.take_connections(), 0);
  EXPECT_THROW(allow_network(), InputError);
}

}  // namespace

}  // namespace itin
