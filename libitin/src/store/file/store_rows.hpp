// The rows of an open store file, read from any thread: a pool of connections, one thread at a time on each.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <itin/error.hpp>

#include "store/codec/seal.hpp"
#include "store/file/blob_column.hpp"

namespace itin {

class StoreRows {
 public:
  /// Checks that the file is a whole store of a known version. Throws FileError, StoreFormatError, CorruptStore.
  explicit StoreRows(const std::string& path);
  ~StoreRows();

  const std::string& path() const { return path_; }
  std::uint64_t file_bytes() const { return file_bytes_; }
  int version() const { return version_; }

  using Bytes = std::span<const std::uint8_t>;
  /// Calls visit(bytes) with the unsealed bytes of a row, which are valid while it runs. Throws CorruptStore where the
  /// row is missing or damaged, and for a DecodeError of `visit`.
  void read(BlobKind kind, std::uint64_t key, const std::function<void(Bytes)>& visit) const;
  std::string read_metadata() const;
  /// Calls visit(key) with the keys of all rows of a table, ascending. Throws CorruptStore.
  void for_each_key(BlobKind kind, const std::function<void(std::uint64_t)>& visit) const;
  /// Returns the findings of SQLite's own integrity check; empty for a sound file.
  std::vector<std::string> structural_damage() const;

 private:
  struct Connection;
  class Lease;
  std::unique_ptr<Connection> connect() const;

  std::string path_;
  std::uint64_t file_bytes_ = 0;
  int version_ = 0;
  std::uint64_t device_ = 0, inode_ = 0;
  // Connections that no thread uses, each in the slot where its last user looks first. Slots are cache lines apart.
  struct alignas(64) Slot {
    std::atomic<Connection*> connection = nullptr;
  };
  mutable std::array<Slot, 32> idle_;
};

/// Returns what `decode` makes of a row's bytes. Throws as StoreRows::read() does.
template <typename Decode>
auto decoded(const StoreRows& rows, BlobKind kind, std::uint64_t key, const Decode& decode) {
  std::optional<decltype(decode(StoreRows::Bytes()))> result;
  rows.read(kind, key, [&](StoreRows::Bytes bytes) { result.emplace(decode(bytes)); });
  return *std::move(result);
}

}  // namespace itin
