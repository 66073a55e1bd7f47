// Rows of a store changed by hand: damaged, or with other contents under checksums that fit.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "store/codec/seal.hpp"
#include "store/metadata_json.hpp"

namespace itin::test {

using SqlValue = std::variant<std::int64_t, std::string, std::vector<std::uint8_t>>;

/// Runs SQL statements, each with these values, on any file of SQLite.
inline void execute_sql(const std::string& path, const std::string& sql, const std::vector<SqlValue>& values = {}) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  for (const char* rest = sql.c_str(); *rest != '\0';) {
    sqlite3_stmt* statement = nullptr;
    ASSERT_EQ(sqlite3_prepare_v2(database, rest, -1, &statement, &rest), SQLITE_OK) << sqlite3_errmsg(database);
    if (statement == nullptr) break;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const int at = static_cast<int>(i) + 1;
      if (const auto* whole = std::get_if<std::int64_t>(&values[i])) sqlite3_bind_int64(statement, at, *whole);
      if (const auto* text = std::get_if<std::string>(&values[i]))
        sqlite3_bind_text(statement, at, text->data(), static_cast<int>(text->size()), SQLITE_TRANSIENT);
      if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&values[i]))
        sqlite3_bind_blob(statement, at, bytes->data(), static_cast<int>(bytes->size()), SQLITE_TRANSIENT);
    }
    int step = SQLITE_ROW;
    while (step == SQLITE_ROW) step = sqlite3_step(statement);
    EXPECT_EQ(step, SQLITE_DONE) << sqlite3_errmsg(database);
    sqlite3_finalize(statement);
  }
  sqlite3_close(database);
}

inline void forge_row(const std::string& path, BlobKind kind, std::uint64_t key,
                      const std::vector<std::uint8_t>& bytes) {
  const std::string table = kind == BlobKind::Block ? "block" : "directory";
  execute_sql(path, "INSERT OR REPLACE INTO " + table + "(key, data) VALUES(?, ?)",
              {static_cast<std::int64_t>(key), seal(kind, key, bytes)});
}

inline void forge_metadata(const std::string& path, const StoreMetadata& metadata) {
  const std::string json = metadata_to_json(metadata);
  execute_sql(path, "UPDATE metadata SET value = ?, checksum = ? WHERE name = 'store'", {json, text_checksum(json)});
}

}  // namespace itin::test
