// Stores made before imports minded that lengths in their CRS are true.
#include <gtest/gtest.h>

#include <itin/store.hpp>

#include "cli/shell.hpp"
#include "gdal/crs.hpp"
#include "support/forged_rows.hpp"

namespace itin::test {

namespace {

/// Makes the store one in this CRS, its coordinates as they are.
void relabel(const std::string& path, const std::string& crs) {
  StoreMetadata metadata = Store(path).metadata();
  metadata.crs_wkt = parse_crs(crs, "test").wkt;
  metadata.scale.reset();  // which such stores did not keep
  forge_metadata(path, metadata);
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

TEST(OldStore, WithAxesToTheWestAndSouthIsWarnedOf) {
  const Shell shell;
  write_hill(shell.directory() / "hill.asc");
  ASSERT_EQ(shell.run("itin import --quiet old.itin hill.asc").status, 0);
  relabel((shell.directory() / "old.itin").string(), "EPSG:2065");
  for (const char* call : {"info old.itin", "los old.itin --from 300500,170500 --to 301500,171400",
                           "tin old.itin --wedge 301025,171025,90,30,500 -o t.ply"}) {
    const Outcome outcome = shell.run(std::string("itin ") + call);
    EXPECT_NE(
        outcome.err.find("itin: warning: the axes of the store's CRS, S-JTSK (Ferro) / Krovak, do not run to the"),
        std::string::npos)
        << call << "\n"
        << outcome.err;
  }
}

}  // namespace

}  // namespace itin::test
