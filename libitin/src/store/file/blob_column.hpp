// The blobs of a store's table, read by key into memory that is reused.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "store/codec/seal.hpp"
#include "store/file/database.hpp"

struct sqlite3_blob;

namespace itin {

/// Returns "block" or "directory".
const char* table_name(BlobKind kind);

/// Reads the blobs of one table. Must not outlive its database, which must not move meanwhile.
class BlobColumn {
 public:
  BlobColumn(Database& database, BlobKind kind) : database_(&database), kind_(kind) {}

  /// Returns a row's bytes, which are valid until the next call; nothing where there is no such row. Throws
  /// CorruptStore, FileError.
  std::optional<std::span<const std::uint8_t>> read(std::uint64_t key);

 private:
  struct Closer {
    void operator()(sqlite3_blob* blob) const;
  };
  // Returns false where there is no such row.
  bool go_to(std::uint64_t key);
  [[noreturn]] void fail(std::uint64_t key);

  Database* database_;
  BlobKind kind_;
  std::unique_ptr<sqlite3_blob, Closer> handle_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace itin
