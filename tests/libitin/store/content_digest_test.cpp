// The digest of a store's content tells stores apart by what they hold, and by nothing else.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/parallel.hpp>
#include <itin/store.hpp>

#include "support/forged_rows.hpp"
#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

class ContentDigest : public testing::Test {
 protected:
  /// Imports a hill of posts, one of which is raised.
  std::string imported(const std::string& name, double raise) {
    const std::string raster = directory_.file("hill.tif"), store = directory_.file(name + ".itin");
    test::write_raster(raster, {}, [&](int column, int row) {
      return 100 + 3 * column - 2 * row + (column == 20 && row == 20 ? raise : 0);
    });
    ImportOptions options;
    options.sources = {raster};
    NoProgress progress;
    import_terrain(store, options, progress);
    return store;
  }

  static std::string digest(const std::string& store) {
    NoProgress progress;
    return content_digest(Store(store), progress);
  }

  test::TemporaryDirectory directory_;
};

TEST_F(ContentDigest, IsTheSameForEveryImportOfTheSameFile) {
  const std::string first = imported("first", 0), second = imported("second", 0);
  EXPECT_EQ(digest(first).size(), 32U);
  EXPECT_EQ(digest(first).find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(digest(first), digest(second));
}

TEST_F(ContentDigest, LeavesOutTheTimesOfImports) {
  const std::string store = imported("store", 0), before = digest(store);
  StoreMetadata metadata = Store(store).metadata();
  metadata.sources.at(0).imported = "1999-12-31T23:59:59Z";
  test::forge_metadata(store, metadata);
  EXPECT_EQ(Store(store).metadata().sources.at(0).imported, "1999-12-31T23:59:59Z");
  EXPECT_EQ(digest(store), before);
  metadata.sources.at(0).note = "another product";
  test::forge_metadata(store, metadata);
  EXPECT_NE(digest(store), before);
}

TEST_F(ContentDigest, ChangesWithOneHeight) {
  EXPECT_NE(digest(imported("flat", 0)), digest(imported("raised", 0.01)));
}

TEST_F(ContentDigest, RefusesADamagedRow) {
  const std::string store = imported("store", 0);
  test::execute_sql(store,
                    "UPDATE block SET data = substr(data, 1, length(data) - 1) WHERE key = (SELECT max(key) "
                    "FROM block)");
  EXPECT_THROW(digest(store), CorruptStore);
}

TEST_F(ContentDigest, EndsWhereItIsCancelled) {
  struct Cancelling final : Progress {
    void report(std::string_view, double) override {}
    bool cancelled() const override { return true; }
  } progress;
  const Store store(imported("store", 0));
  EXPECT_THROW(content_digest(store, progress), Cancelled);
}

}  // namespace
}  // namespace itin
