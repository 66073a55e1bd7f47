#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <span>
#include <system_error>

#include <xxhash.h>

#include <itin/error.hpp>
#include <itin/packed_file.hpp>

#include "base/disk_sync.hpp"
#include "export/buffered_file.hpp"
#include "export/pending_file.hpp"
#include "store/codec/byte_stream.hpp"
#include "store/codec/zstd_frame.hpp"

namespace itin {

namespace {

constexpr std::string_view kMagic = "itinpack";
constexpr std::size_t kHashBytes = 8;

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string text_of(std::span<const std::uint8_t> bytes) {
  return {bytes.begin(), bytes.end()};
}

/// Returns the hash, its lowest byte first.
std::string hash_of(std::string_view frame) {
  const std::uint64_t hash = content_hash(frame);
  std::string bytes;
  for (std::size_t i = 0; i < kHashBytes; ++i) bytes += static_cast<char>(hash >> 8 * i & 0xff);
  return bytes;
}

std::string read_all(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw FileError(path, "cannot be read");
  return bytes;
}

/// Throws FileError where a folder cannot be brought to disk. Some file systems, as shares of other systems, have no
/// way to ask for that: there a name may be lost with the power, as long as the system has not written it by itself.
void require_on_disk(const std::string& folder) {
  const int failed = sync_folder(folder);
  if (failed != 0 && failed != EINVAL && failed != ENOTSUP && failed != ENOSYS)
    throw FileError(folder, "cannot be brought to disk: " + std::generic_category().message(failed));
}

}  // namespace

std::uint64_t content_hash(std::string_view bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

void write_packed(const std::string& path, std::string_view bytes) {
  const std::string frame = text_of(compress(bytes_of(bytes)));
  PendingFile output(path, true);
  BufferedFile file(output);
  file.write(std::string(kMagic) + hash_of(frame) + frame);
  file.close_synced();
  output.commit();
  sync_folder_of(path);
}

std::string read_packed(const std::string& path) {
  const std::string file = read_all(path);
  const std::string_view all = file;
  if (all.size() < kMagic.size() + kHashBytes || all.substr(0, kMagic.size()) != kMagic)
    throw FileError(path, "is no file that itin packed");
  const std::string_view frame = all.substr(kMagic.size() + kHashBytes);
  if (all.substr(kMagic.size(), kHashBytes) != hash_of(frame))
    throw FileError(path, "is damaged: its checksum does not match");
  try {
    return text_of(decompress(bytes_of(frame), std::numeric_limits<std::uint32_t>::max() * std::size_t{256}));
  } catch (const DecodeError& error) {
    throw FileError(path, error.what());
  }
}

Placed place_for_good(const std::string& path, const std::string& last_name) {
  namespace fs = std::filesystem;
  std::error_code failed;
  fs::create_hard_link(path, last_name, failed);
  // Some file systems have no links; there a name that is free is taken by renaming.
  if (failed && failed != std::errc::file_exists &&
      ::renameat2(AT_FDCWD, path.c_str(), AT_FDCWD, last_name.c_str(), RENAME_NOREPLACE) == 0)
    failed.clear();
  if (failed && !fs::exists(last_name)) throw FileError(last_name, "cannot be written: " + failed.message());
  const bool placed = !failed;
  if (!placed && read_all(path) != read_all(last_name)) return Placed::kDiffering;
  require_on_disk(fs::path(last_name).parent_path().string());
  fs::remove(path, failed);
  return placed ? Placed::kPlaced : Placed::kSame;
}

}  // namespace itin
