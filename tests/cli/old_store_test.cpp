// Stores made before imports minded that lengths in their CRS are true.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <itin/store.hpp>

#include "cli/shell.hpp"
#include "gdal/crs.hpp"
#include "store/metadata_json.hpp"
#include "store/seal.hpp"

namespace itin::test {

namespace {

/// Makes the store one in this CRS, its coordinates as they are.
void relabel(const std::string& path, const std::string& crs) {
  StoreMetadata metadata = Store(path).metadata();
  metadata.crs_wkt = parse_crs(crs, "test").wkt;
  const std::string json = metadata_to_json(metadata);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  sqlite3_stmt* update = nullptr;
  sqlite3_prepare_v2(database, "UPDATE metadata SET value = ?, checksum = ? WHERE name = 'store'", -1, &update,
                     nullptr);
  sqlite3_bind_text(update, 1, json.c_str(), -1, SQLITE_TRANSIENT);
  sqlite3_bind_int64(update, 2, text_checksum(json));
  ASSERT_EQ(sqlite3_step(update), SQLITE_DONE);
  sqlite3_finalize(update);
  sqlite3_close(database);
}

TEST(OldStore, WithWrongLengthsIsWarnedOf) {
  const Shell shell;
  write_hill(shell.directory() / "hill.asc");
  ASSERT_EQ(shell.run("itin import --quiet old.itin hill.asc").status, 0);
  relabel((shell.directory() / "old.itin").string(), "EPSG:3035");
  for (const char* call :
       {"info old.itin", "los old.itin --from 300500,170500 --to 301500,171400",
        "profile old.itin --from 300500,170500 --to 301500,171400 -o p.csv", "tin old.itin --all -o t.ply",
        "viewshed old.itin --observer 301025,171025,2 --radius 500 --cell 50 -o v.tif",
        "visibility old.itin --all --cell 500 --radius 500 --observer-height 2 -o i.tif"}) {
    const Outcome outcome = shell.run(std::string("itin ") + call);
    EXPECT_EQ(outcome.status, 0) << call << outcome.err;
    EXPECT_NE(outcome.err.find("itin: warning: lengths in the store's CRS, ETRS89-extended / LAEA Europe, are up to"),
              std::string::npos)
        << call << "\n"
        << outcome.err;
  }
}

}  // namespace

}  // namespace itin::test
