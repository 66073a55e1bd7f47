#include "store/store_rows.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <sys/stat.h>

#include <fmt/format.h>

namespace itin {

namespace {

constexpr std::size_t kHeaderBytes = 100;
using FileHeader = std::array<unsigned char, kHeaderBytes>;

struct stat file_status(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) throw FileError(path, std::strerror(errno));
  return status;
}

std::uint32_t big_endian(const FileHeader& header, std::size_t offset) {
  return std::uint32_t{header[offset]} << 24 | std::uint32_t{header[offset + 1]} << 16 |
         std::uint32_t{header[offset + 2]} << 8 | header[offset + 3];
}

// SQLite's own header, read without it: most files that are no store are told apart here, and a file that is shorter
// or longer than it should be. Returns the format version.
int checked_version(const std::string& path, std::uint64_t file_bytes) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path, std::string("cannot be read: ") + std::strerror(errno));
  FileHeader header{};
  file.read(reinterpret_cast<char*>(header.data()), kHeaderBytes);
  constexpr std::string_view magic("SQLite format 3\0", 16);
  const auto read = static_cast<std::size_t>(file.gcount());
  if (std::memcmp(header.data(), magic.data(), std::min(read, magic.size())) != 0 || read == 0) {
    throw StoreFormatError(path, "is not an itin store; name one that itin import made, or a new file to import into");
  }
  if (read < kHeaderBytes) throw CorruptStore(path, "header", "is cut short; restore a copy or import again");
  if (big_endian(header, 68) != format::kApplicationId) {
    throw StoreFormatError(path, "is an SQLite file of another program, not an itin store");
  }
  const std::uint32_t version = big_endian(header, 60);
  if (version > format::kVersion) {
    throw StoreFormatError(path, fmt::format("has store format {}, this itin reads up to {}; use a newer itin", version,
                                             format::kVersion));
  }
  if (version == 2) {
    throw StoreFormatError(path, "has store format 2, which no release of itin wrote; import its sources again");
  }
  if (version == 0) throw CorruptStore(path, "header", "has no format version; restore a copy or import again");
  const std::uint32_t raw_page = std::uint32_t{header[16]} << 8 | header[17];
  const std::uint64_t page_bytes = raw_page == 1 ? 65536 : raw_page;
  const std::uint64_t expected = big_endian(header, 28) * page_bytes;
  if (expected != file_bytes) {
    throw CorruptStore(path, "header",
                       fmt::format("the file has {} bytes where {} are expected; restore a copy or "
                                   "import again",
                                   file_bytes, expected));
  }
  return static_cast<int>(version);
}

}  // namespace

const char* table_name(BlobKind kind) {
  return kind == BlobKind::Block ? "block" : "directory";
}

struct StoreRows::Connection {
  explicit Connection(const std::string& path)
      : database(Database::open(path)),
        block(database.prepare("SELECT data FROM block WHERE key = ?")),
        directory(database.prepare("SELECT data FROM directory WHERE key = ?")) {}
  Database database;
  Statement block, directory;
};

// Gives its connection back when it ends.
class StoreRows::Lease {
 public:
  explicit Lease(const StoreRows& rows) : rows_(rows) {
    {
      const std::lock_guard lock(rows_.mutex_);
      if (!rows_.idle_.empty()) {
        connection_ = std::move(rows_.idle_.back());
        rows_.idle_.pop_back();
      }
    }
    if (!connection_) connection_ = rows_.connect();
  }
  ~Lease() {
    const std::lock_guard lock(rows_.mutex_);
    rows_.idle_.push_back(std::move(connection_));
  }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
  Connection* operator->() const { return connection_.get(); }

 private:
  const StoreRows& rows_;
  std::unique_ptr<Connection> connection_;
};

StoreRows::StoreRows(const std::string& path) : path_(path) {
  const struct stat status = file_status(path);
  if (S_ISDIR(status.st_mode)) throw FileError(path, "is a directory, not a store");
  if (!S_ISREG(status.st_mode)) throw FileError(path, "is not a regular file");
  file_bytes_ = static_cast<std::uint64_t>(status.st_size);
  device_ = status.st_dev, inode_ = status.st_ino;
  version_ = checked_version(path, file_bytes_);
  idle_.push_back(connect());
}

StoreRows::~StoreRows() = default;

// An import replaces the whole file under its name. Two connections of one Store must not read two different stores;
// the first connection keeps the old file, and with it its inode number, alive.
std::unique_ptr<StoreRows::Connection> StoreRows::connect() const {
  auto connection = std::make_unique<Connection>(path_);
  const struct stat status = file_status(path_);
  if (status.st_dev != device_ || status.st_ino != inode_) {
    throw FileError(path_, "was replaced while it was being read; run this again");
  }
  return connection;
}

std::vector<std::uint8_t> StoreRows::read(BlobKind kind, std::uint64_t key) const {
  const std::string place = format::place(table_name(kind), key);
  std::vector<std::uint8_t> sealed;
  {
    const Lease connection(*this);
    Statement& statement = kind == BlobKind::Block ? connection->block : connection->directory;
    const StatementReset reset(statement);
    statement.bind(1, static_cast<std::int64_t>(key));
    if (!statement.step(place)) throw CorruptStore(path_, place, "is missing; restore a copy or import again");
    sealed = statement.blob(0);
  }
  try {
    const auto bytes = unseal(kind, key, sealed);
    return {bytes.begin(), bytes.end()};
  } catch (const DecodeError& e) {
    throw CorruptStore(path_, place, e.what());
  }
}

std::string StoreRows::read_metadata() const {
  const Lease connection(*this);
  Statement statement = connection->database.prepare("SELECT value, checksum FROM metadata WHERE name = 'store'");
  if (!statement.step("metadata")) throw CorruptStore(path_, "metadata", "is missing; restore a copy or import again");
  std::string text = statement.text(0);
  if (text_checksum(text) != statement.integer(1)) {
    throw CorruptStore(path_, "metadata", "checksum does not match, the data is damaged");
  }
  return text;
}

void StoreRows::for_each_key(BlobKind kind, const std::function<void(std::uint64_t)>& visit) const {
  const Lease connection(*this);
  const std::string table = table_name(kind);
  Statement statement = connection->database.prepare("SELECT key FROM " + table + " ORDER BY key");
  while (statement.step(table)) visit(static_cast<std::uint64_t>(statement.integer(0)));
}

std::vector<std::string> StoreRows::structural_damage() const {
  const Lease connection(*this);
  std::vector<std::string> found;
  Statement statement = connection->database.prepare("PRAGMA integrity_check");
  while (statement.step("file")) {
    if (statement.text(0) != "ok") found.push_back(statement.text(0));
  }
  return found;
}

}  // namespace itin
