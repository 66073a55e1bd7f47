#include "store/file/store_rows.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <sys/stat.h>

#include <fmt/format.h>

#include "store/codec/byte_stream.hpp"
#include "store/codec/store_format.hpp"
#include "store/file/database.hpp"

namespace itin {

namespace {

constexpr std::size_t kHeaderBytes = 100;
using FileHeader = std::array<unsigned char, kHeaderBytes>;

struct stat file_status(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0)
    throw FileError(path,
                    errno == ENOENT ? "there is no such store; name one that itin import made" : std::strerror(errno));
  return status;
}

std::uint32_t big_endian(const FileHeader& header, std::size_t offset) {
  return std::uint32_t{header[offset]} << 24 | std::uint32_t{header[offset + 1]} << 16 |
         std::uint32_t{header[offset + 2]} << 8 | header[offset + 3];
}

// Reads SQLite's own header, without SQLite, and returns the format version. Most files that are no store are
// recognised here, and files that are shorter or longer than they should be.
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
    throw StoreFormatError(path, fmt::format("has store format {}, this itin reads format {}; use a newer itin",
                                             version, format::kVersion));
  }
  if (version == 0) throw CorruptStore(path, "header", "has no format version; restore a copy or import again");
  if (version < format::kVersion) {
    throw StoreFormatError(path, fmt::format("has store format {}, which this itin reads no more; import its sources "
                                             "again",
                                             version));
  }
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

struct StoreRows::Connection {
  explicit Connection(const std::string& path)
      : database(Database::open(path)), blocks(database, BlobKind::Block), directory(database, BlobKind::Directory) {}
  Database database;
  BlobColumn blocks, directory;
};

// A connection on loan. It goes back to the pool when the lease ends.
class StoreRows::Lease {
 public:
  explicit Lease(const StoreRows& rows) : rows_(rows) {
    for (std::size_t i = 0; i < rows_.idle_.size() && !connection_; ++i) {
      auto& idle = slot(i);
      if (idle.load(std::memory_order_relaxed) != nullptr) connection_.reset(idle.exchange(nullptr));
    }
    if (!connection_) connection_ = rows_.connect();
  }
  ~Lease() {
    for (std::size_t i = 0; i < rows_.idle_.size() && connection_; ++i) {
      Connection* none = nullptr;
      if (slot(i).compare_exchange_strong(none, connection_.get())) (void)connection_.release();
    }
  }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
  Connection* operator->() const { return connection_.get(); }

 private:
  // Returns the i-th slot in the order in which this thread tries them.
  std::atomic<Connection*>& slot(std::size_t i) const {
    static std::atomic<std::size_t> threads = 0;
    thread_local const std::size_t first = threads++;
    return rows_.idle_[(first + i) % rows_.idle_.size()].connection;
  }

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
  idle_.front().connection = connect().release();
}

StoreRows::~StoreRows() {
  for (Slot& slot : idle_) std::unique_ptr<Connection>(slot.connection.load());
}

// Opens a connection. An import replaces the whole file under its name, but two connections of one Store must not read
// two different stores. The first connection keeps the old file, and with it its inode number, alive.
std::unique_ptr<StoreRows::Connection> StoreRows::connect() const {
  auto connection = std::make_unique<Connection>(path_);
  const struct stat status = file_status(path_);
  if (status.st_dev != device_ || status.st_ino != inode_) {
    throw FileError(path_, "was replaced while it was being read; run this again");
  }
  return connection;
}

void StoreRows::read(BlobKind kind, std::uint64_t key, const std::function<void(Bytes)>& visit) const {
  const auto damaged = [&](const std::string& how) {
    return CorruptStore(path_, format::place(table_name(kind), key), how);
  };
  const Lease connection(*this);
  BlobColumn& blobs = kind == BlobKind::Block ? connection->blocks : connection->directory;
  const auto sealed = blobs.read(key);
  if (!sealed) throw damaged("is missing; restore a copy or import again");
  try {
    visit(unseal(kind, key, *sealed));
  } catch (const DecodeError& e) {
    throw damaged(e.what());
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
