// SQLite with itin's errors. One connection, for one thread at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace itin {

class Statement;

/// A database. Messages name `shown`, the store that the user knows, whatever file it is written to.
class Database {
 public:
  /// Creates an empty database in the file at `path`, without journal or syncs: the caller renames the file when
  /// complete.
  static Database create(const std::string& path, const std::string& shown);
  /// Opens a file for reading. Precondition: nobody changes it in place.
  static Database open(const std::string& path);

  void execute(const std::string& sql);
  Statement prepare(const std::string& sql);
  /// Throws FileError when writing out fails, which the destructor could not report.
  void close();

 private:
  friend class Statement;
  friend class BlobColumn;
  struct Closer {
    void operator()(sqlite3* db) const;
  };
  Database(std::string shown, bool reading) : shown_(std::move(shown)), reading_(reading) {}
  void open_handle(const std::string& path, int flags);
  [[noreturn]] void fail(const std::string& place) const;

  std::unique_ptr<sqlite3, Closer> handle_;
  std::string shown_;
  bool reading_ = false;
};

/// A prepared statement. Must not outlive its database, which must not move meanwhile.
class Statement {
 public:
  void bind(int index, std::int64_t v);
  void bind(int index, const std::string& v);
  void bind(int index, std::span<const std::uint8_t> v);
  /// Moves to the next row; returns false where there is none. `place` goes into errors.
  bool step(const std::string& place);
  void reset();

  std::int64_t integer(int column) const;
  std::string text(int column) const;

 private:
  friend class Database;
  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const;
  };
  explicit Statement(Database& database) : database_(&database) {}

  Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalizer> handle_;
};

}  // namespace itin
