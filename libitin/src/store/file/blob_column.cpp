#include "store/file/blob_column.hpp"

#include <string_view>
#include <utility>

#include <sqlite3.h>

#include "store/codec/store_format.hpp"

namespace itin {

const char* table_name(BlobKind kind) {
  return kind == BlobKind::Block ? "block" : "directory";
}

void BlobColumn::Closer::operator()(sqlite3_blob* blob) const {
  sqlite3_blob_close(blob);
}

std::optional<std::span<const std::uint8_t>> BlobColumn::read(std::uint64_t key) {
  if (!go_to(key)) return std::nullopt;
  bytes_.resize(static_cast<std::size_t>(sqlite3_blob_bytes(handle_.get())));
  if (sqlite3_blob_read(handle_.get(), bytes_.data(), static_cast<int>(bytes_.size()), 0) != SQLITE_OK) fail(key);
  return bytes_;
}

bool BlobColumn::go_to(std::uint64_t key) {
  const auto row = static_cast<sqlite3_int64>(key);
  int code = SQLITE_OK;
  if (handle_) {
    code = sqlite3_blob_reopen(handle_.get(), row);
  } else {
    sqlite3_blob* blob = nullptr;
    code = sqlite3_blob_open(database_->handle_.get(), "main", table_name(kind_), "data", row, 0, &blob);
    handle_.reset(blob);
  }
  if (code == SQLITE_OK) return true;
  if (!std::string_view(sqlite3_errmsg(database_->handle_.get())).starts_with("no such rowid")) fail(key);
  handle_.reset();
  return false;
}

void BlobColumn::fail(std::uint64_t key) {
  const auto useless = std::move(handle_);  // closed once the message is made
  database_->fail(format::place(table_name(kind_), key));
}

}  // namespace itin
