// A store whose directory says something else than what was imported, under checksums that fit.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "store/codec/store_format.hpp"
#include "store/file/directory.hpp"
#include "store/file/store_rows.hpp"
#include "support/forged_rows.hpp"
#include "support/row_bytes.hpp"

namespace itin::test {

/// Calls change(leaves) for each chunk of the tree, and writes the leaves that it keeps.
inline void forge_directory(const std::string& path, int tree, const std::function<void(DirectoryChunk&)>& change) {
  using Row = std::pair<std::uint64_t, std::vector<std::uint8_t>>;
  std::vector<std::uint64_t> old_keys;
  std::vector<Row> rows;
  {
    const StoreRows store(path);
    ChunkList list = decode_chunk_list(bytes_of(store, BlobKind::Directory, format::kChunkListKey));
    std::vector<ChunkEntry> entries;
    for (const ChunkEntry& entry : list.at(tree)) {
      old_keys.push_back(format::key(tree, entry.code));
      DirectoryChunk chunk = decode_chunk(bytes_of(store, BlobKind::Directory, old_keys.back()), tree, entry);
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
  for (const std::uint64_t key : old_keys)
    execute_sql(path, "DELETE FROM directory WHERE key = ?", {static_cast<std::int64_t>(key)});
  for (const auto& [key, bytes] : rows) forge_row(path, BlobKind::Directory, key, bytes);
}

}  // namespace itin::test
