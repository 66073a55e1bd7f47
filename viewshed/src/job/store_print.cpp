#include <array>
#include <filesystem>
#include <fstream>

#include <viewshed/job.hpp>

namespace itin::viewshed {

namespace {

/// Where an SQLite database counts its changes, four bytes with the highest first (its file format, section 1.3).
constexpr std::streamoff kChangesAt = 24;

}  // namespace

StorePrint print_of_store(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<unsigned char, 4> bytes{};
  file.seekg(kChangesAt);
  file.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
  std::error_code error;
  StorePrint print{std::filesystem::file_size(path, error), 0};
  if (!file || error) throw FileError(path, "cannot be read as a store");
  for (const unsigned char byte : bytes) print.changes = print.changes << 8 | byte;
  return print;
}

}  // namespace itin::viewshed
