// A store whose directory says something else than what was imported, under checksums that fit.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "store/directory.hpp"
#include "store/seal.hpp"
#include "store/store_format.hpp"
#include "store/store_rows.hpp"

namespace itin::test {

/// Calls change(leaves) for each chunk of the tree, and writes what it leaves of them.
inline void forge_directory(const std::string& path, int tree, const std::function<void(DirectoryChunk&)>& change) {
  using Row = std::pair<std::uint64_t, std::vector<std::uint8_t>>;
  std::vector<std::uint64_t> old_keys;
  std::vector<Row> rows;
  {
    const StoreRows store(path);
    ChunkList list = decode_chunk_list(store.read(BlobKind::Directory, format::kChunkListKey));
    std::vector<ChunkEntry> entries;
    for (const ChunkEntry& entry : list.at(tree)) {
      old_keys.push_back(format::key(tree, entry.code));
      DirectoryChunk chunk = decode_chunk(store.read(BlobKind::Directory, old_keys.back()), tree, entry);
      change(chunk);
      if (chunk.empty()) continue;
      entries.push_back(entry_of(chunk));
      rows.emplace_back(chunk.front().key, encode_chunk(chunk));
    }
    if (entries.empty()) {
      list.erase(tree);
    } else {
      list[tree] = entries;
    }
    old_keys.push_back(format::kChunkListKey);
    rows.emplace_back(format::kChunkListKey, encode_chunk_list(list));
  }
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  const auto run = [&](const char* sql, std::uint64_t key, const std::vector<std::uint8_t>* data) {
    sqlite3_stmt* statement = nullptr;
    ASSERT_EQ(sqlite3_prepare_v2(database, sql, -1, &statement, nullptr), SQLITE_OK);
    sqlite3_bind_int64(statement, 1, static_cast<sqlite3_int64>(key));
    if (data != nullptr)
      sqlite3_bind_blob(statement, 2, data->data(), static_cast<int>(data->size()), SQLITE_TRANSIENT);
    EXPECT_EQ(sqlite3_step(statement), SQLITE_DONE);
    sqlite3_finalize(statement);
  };
  for (const std::uint64_t key : old_keys) run("DELETE FROM directory WHERE key = ?", key, nullptr);
  for (const auto& [key, bytes] : rows) {
    const std::vector<std::uint8_t> sealed = seal(BlobKind::Directory, key, bytes);
    run("INSERT INTO directory(key, data) VALUES(?, ?)", key, &sealed);
  }
  sqlite3_close(database);
}

}  // namespace itin::test
