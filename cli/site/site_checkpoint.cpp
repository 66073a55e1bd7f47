#include "site/site_checkpoint.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include <itin/error.hpp>

namespace itin::cli {

namespace {

using viewshed::CoverageBounds;
using viewshed::DemandSet;

/// Returns an FNV-1a checksum, which guards against records cut short, not against malice.
std::uint64_t checksum(const std::string& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

void put(std::string& bytes, std::uint64_t value) {
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

void put(std::string& bytes, const DemandSet& set) {
  put(bytes, set.blocks().size());
  for (const DemandSet::Block& block : set.blocks()) put(bytes, block.number), put(bytes, block.members);
}

class RecordReader {
 public:
  explicit RecordReader(const std::string& bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  std::optional<std::uint64_t> word() {
    if (at_ + 8 > bytes_.size()) return std::nullopt;
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[at_ + static_cast<std::size_t>(i)]))
               << (8 * i);
    at_ += 8;
    return value;
  }
  std::optional<std::string> text(std::uint64_t size) {
    if (size > bytes_.size() - at_) return std::nullopt;
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  std::optional<DemandSet> set() {
    const auto count = word();
    if (!count || *count > bytes_.size() / 16) return std::nullopt;
    DemandSet result;
    for (std::uint64_t i = 0; i < *count; ++i) {
      const auto number = word(), members = word();
      if (!members) return std::nullopt;
      result.add(static_cast<std::uint32_t>(*number), *members);
    }
    return result;
  }
  std::size_t at() const { return at_; }

 private:
  const std::string& bytes_;
  std::size_t at_;
};

std::string header(const std::string& key) {
  return "itin site work 2\n" + key + "\n";
}

/// Puts records back. Returns where the last whole one ends.
std::size_t restore(const std::string& bytes, std::size_t from, std::size_t options, viewshed::SiteCoverage& coverage,
                    std::size_t& count, Progress& progress) {
  std::size_t end = from;
  for (;;) {
    progress.throw_if_cancelled();
    progress.report("results of the earlier run", static_cast<double>(end) / static_cast<double>(bytes.size()));
    RecordReader frame(bytes, end);
    const auto size = frame.word(), sum = frame.word();
    if (!sum) return end;
    const auto record = frame.text(*size);
    if (!record || checksum(*record) != *sum) return end;
    RecordReader reader(*record, 0);
    const auto option = reader.word(), stage = reader.word(), exact = reader.word();
    auto certain = reader.set(), possible = reader.set();
    if (!possible || *option >= options || *stage > static_cast<std::uint64_t>(coverage.last_stage())) return end;
    coverage.restore(*option, static_cast<int>(*stage),
                     {.certain = std::move(*certain), .possible = std::move(*possible), .exact = *exact != 0});
    ++count;
    end = frame.at();
  }
}

}  // namespace

SiteCheckpoint::SiteCheckpoint(std::string path, const std::string& key, bool resume, std::size_t options,
                               viewshed::SiteCoverage& coverage, Progress& progress)
    : path_(std::move(path)) {
  const std::string head = header(key);
  std::size_t keep = 0;
  if (resume) {
    std::ifstream file(path_, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (bytes.compare(0, head.size(), head) == 0)
      keep = restore(bytes, head.size(), options, coverage, restored_, progress);
  }
  std::error_code failed;
  if (keep > 0) std::filesystem::resize_file(path_, keep, failed);
  file_.reset(failed ? nullptr : std::fopen(path_.c_str(), keep > 0 ? "ab" : "wb"));
  const bool written = file_ && (keep > 0 || (std::fwrite(head.data(), 1, head.size(), file_.get()) == head.size() &&
                                              std::fflush(file_.get()) == 0));
  if (!written) throw FileError(path_, "cannot be written; it keeps what --resume needs");
}

void SiteCheckpoint::add(std::size_t option, int stage, const CoverageBounds& bounds) {
  std::string record;
  put(record, option), put(record, static_cast<std::uint64_t>(stage)), put(record, bounds.exact ? 1 : 0);
  put(record, bounds.certain), put(record, bounds.possible);
  std::string frame;
  put(frame, record.size()), put(frame, checksum(record));
  frame += record;
  if (std::fwrite(frame.data(), 1, frame.size(), file_.get()) != frame.size() || std::fflush(file_.get()) != 0)
    throw FileError(path_, std::string("cannot be written: ") + std::strerror(errno));
}

void SiteCheckpoint::remove() {
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace itin::cli
