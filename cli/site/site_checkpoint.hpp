// The results of a siting run so far, kept in a file so that a killed run can go on.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include <viewshed/site_coverage.hpp>

namespace itin::cli {

/// Records of an option's bounds, one after the other, each with a checksum: a record cut short by a kill is as if it
/// had never been.
class SiteCheckpoint {
 public:
  /// `key` tells runs apart. With `resume` what an earlier run of the same key found is put back into `coverage`;
  /// otherwise, and for other keys, the file begins anew. Throws FileError.
  SiteCheckpoint(std::string path, const std::string& key, bool resume, std::size_t options,
                 viewshed::SiteCoverage& coverage);

  /// How many records were put back.
  std::size_t restored() const { return restored_; }
  void add(std::size_t option, int stage, const viewshed::CoverageBounds& bounds);
  /// The run is over and needs it no more.
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
