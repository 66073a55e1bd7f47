#include "store/file/database.hpp"

#include <cstring>

#include <fmt/format.h>
#include <sqlite3.h>

#include <itin/error.hpp>

namespace itin {

namespace {

// Encodes a path for SQLite's file: URIs; a path may contain any byte.
std::string percent_encoded(const std::string& path) {
  std::string uri;
  for (const char c : path) {
    if (c == '%' || c == '?' || c == '#') {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    } else {
      uri += c;
    }
  }
  return uri;
}

bool means_damage(int code) {
  return code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_ERROR || code == SQLITE_MISMATCH ||
         code == SQLITE_FORMAT || code == SQLITE_TOOBIG || code == SQLITE_CANTOPEN;
}

}  // namespace

void Database::Closer::operator()(sqlite3* db) const {
  sqlite3_close_v2(db);
}

void Database::open_handle(const std::string& path, int flags) {
  sqlite3* db = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &db, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  handle_.reset(db);
  if (code != SQLITE_OK) fail("header");
  sqlite3_extended_result_codes(db, 1);
}

Database Database::create(const std::string& path, const std::string& shown) {
  Database database(shown, false);
  database.open_handle(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  database.execute("PRAGMA locking_mode=EXCLUSIVE; PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF;");
  return database;
}

Database Database::open(const std::string& path) {
  Database database(path, true);
  const std::string authority = path.starts_with('/') ? "file://" : "file:";
  database.open_handle(authority + percent_encoded(path) + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
  // All reads are in one transaction; otherwise each would begin and end its own.
  database.execute("PRAGMA cache_size=-1024; PRAGMA cell_size_check=ON; PRAGMA trusted_schema=OFF; BEGIN;");
  return database;
}

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail("schema");
}

Statement Database::prepare(const std::string& sql) {
  Statement statement(*this);
  sqlite3_stmt* handle = nullptr;
  const int code = sqlite3_prepare_v2(handle_.get(), sql.c_str(), -1, &handle, nullptr);
  statement.handle_.reset(handle);
  if (code != SQLITE_OK) fail("schema");
  return statement;
}

void Database::close() {
  if (sqlite3_close(handle_.get()) != SQLITE_OK) fail("file");
  (void)handle_.release();
}

void Database::fail(const std::string& place) const {
  const int extended = handle_ ? sqlite3_extended_errcode(handle_.get()) : SQLITE_NOMEM;
  const std::string message = handle_ ? sqlite3_errmsg(handle_.get()) : "out of memory";
  const int code = extended & 0xff;
  if (reading_ && (means_damage(code) || extended == SQLITE_IOERR_SHORT_READ)) {
    throw CorruptStore(shown_, place, message + "; import it again or restore a copy");
  }
  const int system = handle_ ? sqlite3_system_errno(handle_.get()) : 0;
  const std::string reason = system != 0 ? fmt::format(" ({})", std::strerror(system)) : "";
  if (reading_) throw FileError(shown_, place + ": cannot be read: " + message + reason);
  if (code == SQLITE_FULL) throw FileError(shown_, "the disk is full" + reason + "; make room and try again");
  throw FileError(shown_, "cannot be written: " + message + reason);
}

void Statement::Finalizer::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

void Statement::bind(int index, std::int64_t v) {
  if (sqlite3_bind_int64(handle_.get(), index, v) != SQLITE_OK) database_->fail("statement");
}

void Statement::bind(int index, const std::string& v) {
  if (sqlite3_bind_text64(handle_.get(), index, v.data(), v.size(), SQLITE_TRANSIENT, SQLITE_UTF8) != SQLITE_OK) {
    database_->fail("statement");
  }
}

void Statement::bind(int index, std::span<const std::uint8_t> v) {
  if (sqlite3_bind_blob64(handle_.get(), index, v.data(), v.size(), SQLITE_TRANSIENT) != SQLITE_OK) {
    database_->fail("statement");
  }
}

bool Statement::step(const std::string& place) {
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  database_->fail(place);
}

void Statement::reset() {
  sqlite3_reset(handle_.get());
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(handle_.get(), column);
}

std::string Statement::text(int column) const {
  const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  return data ? std::string(data, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))) : "";
}

}  // namespace itin
