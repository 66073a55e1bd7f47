// A file without a name, for data that does not fit in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace itin {

/// A file that is unlinked right after opening, so that nothing outlives a kill. Reading and writing at offsets is safe
/// from any thread as far as ranges do not overlap.
class TemporaryFile {
 public:
  /// Throws FileError.
  explicit TemporaryFile(std::string directory);
  TemporaryFile(TemporaryFile&&) noexcept;
  TemporaryFile& operator=(TemporaryFile&&) noexcept;
  ~TemporaryFile();

  /// Throws FileError, also where the file ends early.
  void read(std::uint64_t offset, void* bytes, std::size_t count) const;
  /// Throws FileError; a full disk is named as such.
  void write(std::uint64_t offset, const void* bytes, std::size_t count);

 private:
  std::string directory_;
  int descriptor_ = -1;
};

}  // namespace itin
