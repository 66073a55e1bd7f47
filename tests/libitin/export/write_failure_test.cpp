// What is said of a file that GDAL cannot write: the reason, without the insides of other libraries.
#include "gdal/files/write_failure.hpp"

#include <cpl_error.h>
#include <gtest/gtest.h>

#include "gdal/files/quiet_gdal.hpp"

namespace itin {
namespace {

std::string said_of(const char* message) {
  const QuietGdal quiet;
  if (*message != '\0') CPLError(CE_Failure, CPLE_FileIO, "%s", message);
  return write_failure("cannot be created");
}

TEST(WriteFailure, NamesTheReasonAlone) {
  for (const char* full :
       {"sqlite3_exec(COMMIT) failed: database or disk is full", "failed to execute insert : database or disk is full",
        "_tiffWriteProc:No space left on device"})
    EXPECT_EQ(said_of(full), "cannot be written: No space left on device") << full;
  EXPECT_EQ(said_of("_tiffSeekProc:File too large"), "cannot be written: File too large");
  EXPECT_EQ(said_of("Attempt to create new tiff file `/proc/.x.part7-1.tif' failed: No such file or directory"),
            "cannot be written: No such file or directory");
  EXPECT_EQ(
      said_of("sqlite3_exec(CREATE TABLE \"a: b\" (\"fid\" INTEGER)) failed: attempt to write a readonly database"),
      "cannot be written: attempt to write a readonly database");
}

TEST(WriteFailure, SaysWhatToDoWhereTheDiskRefuses) {
  EXPECT_EQ(said_of("failed to execute insert : disk I/O error"),
            "cannot be written: the disk refuses it; check the disk, and the limit on the size of files");
}

TEST(WriteFailure, KeepsOtherReasonsWhole) {
  EXPECT_EQ(said_of("Layer 'a: b' is not understood"), "cannot be written: Layer 'a: b' is not understood");
  EXPECT_EQ(said_of(""), "cannot be created");
}

}  // namespace
}  // namespace itin
