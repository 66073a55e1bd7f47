// The results of a siting run so far, kept in a file so that a killed run can go on.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include <itin/progress.hpp>
#include <viewshed/site_coverage.hpp>

namespace itin::cli {

/// A file of records of options' bounds, each with a checksum. A record cut short by a kill is ignored.
class SiteCheckpoint {
 public:
  /// Opens the file. `key` tells runs apart. With `resume`, bounds that an earlier run of the same key found are put
  /// back into `coverage`, of so many `options`; otherwise, and for other keys, the file begins anew. Throws FileError,
  /// Cancelled.
  SiteCheckpoint(std::string path, const std::string& key, bool resume, std::size_t options,
                 viewshed::SiteCoverage& coverage, Progress& progress);

  /// Returns how many records were put back.
  std::size_t restored() const { return restored_; }
  void add(std::size_t option, int stage, const viewshed::CoverageBounds& bounds);
  /// Removes the file once the run is over.
  void remove();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::size_t restored_ = 0;
};

}  // namespace itin::cli
