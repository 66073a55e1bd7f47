// The rows of an open store file, read from any thread: a pool of connections, one thread at a time on each.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <itin/error.hpp>

#include "store/byte_stream.hpp"
#include "store/database.hpp"
#include "store/seal.hpp"
#include "store/store_format.hpp"

namespace itin {

class StoreRows {
 public:
  /// Checks that the file is a whole store of a version we know. Throws FileError, StoreFormatError, CorruptStore.
  explicit StoreRows(const std::string& path);
  ~StoreRows();

  const std::string& path() const { return path_; }
  std::uint64_t file_bytes() const { return file_bytes_; }
  int version() const { return version_; }

  /// The unsealed bytes of a row. Throws CorruptStore where it is missing or damaged.
  std::vector<std::uint8_t> read(BlobKind kind, std::uint64_t key) const;
  std::string read_metadata() const;
  /// The keys of all rows of a table, ascending. Throws CorruptStore.
  void for_each_key(BlobKind kind, const std::function<void(std::uint64_t)>& visit) const;
  /// The findings of SQLite's own integrity check; empty for a sound file.
  std::vector<std::string> structural_damage() const;

 private:
  struct Connection;
  class Lease;
  std::unique_ptr<Connection> connect() const;

  std::string path_;
  std::uint64_t file_bytes_ = 0;
  int version_ = 0;
  std::uint64_t device_ = 0, inode_ = 0;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Connection>> idle_;
};

/// "block" or "directory".
const char* table_name(BlobKind kind);

/// Reads a row and runs `decode` on its bytes, naming the place of what it throws.
template <typename Decode>
auto decoded(const StoreRows& rows, BlobKind kind, std::uint64_t key, const Decode& decode) {
  const std::vector<std::uint8_t> bytes = rows.read(kind, key);
  try {
    return decode(bytes);
  } catch (const DecodeError& e) {
    throw CorruptStore(rows.path(), format::place(table_name(kind), key), e.what());
  }
}

}  // namespace itin
