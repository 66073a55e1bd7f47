// A digest of all that a store holds.

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <xxhash.h>

#include <itin/call_progress.hpp>
#include <itin/parallel.hpp>
#include <itin/store.hpp>

#include "store/store_file.hpp"

namespace itin {

namespace {

constexpr std::size_t kRowsPerTask = 64;

/// A sum of hashes, which does not depend on the order in which they are added.
class HashSum {
 public:
  void add(XXH128_hash_t hash) { high_ += hash.high64, low_ += hash.low64; }
  std::string text() const { return fmt::format("{:016x}{:016x}", high_.load(), low_.load()); }

 private:
  std::atomic<std::uint64_t> high_ = 0, low_ = 0;
};

void add_rows(const StoreRows& rows, BlobKind kind, HashSum& sum, Progress& progress) {
  std::vector<std::uint64_t> keys;
  rows.for_each_key(kind, [&](std::uint64_t key) { keys.push_back(key); });
  std::atomic<std::size_t> done = 0;
  parallel_for((keys.size() + kRowsPerTask - 1) / kRowsPerTask, [&](std::size_t task) {
    progress.throw_if_cancelled();
    const std::size_t first = task * kRowsPerTask, last = std::min(keys.size(), first + kRowsPerTask);
    for (std::size_t i = first; i < last; ++i) {
      rows.read(kind, keys[i], [&](StoreRows::Bytes bytes) {
        sum.add(XXH3_128bits_withSeed(bytes.data(), bytes.size(), row_seed(kind, keys[i])));
      });
    }
    progress.report("reading", static_cast<double>(done += last - first) / static_cast<double>(keys.size()));
  });
}

/// Returns the metadata without the times of the imports.
std::string metadata_without_times(const StoreRows& rows) {
  nlohmann::ordered_json metadata = nlohmann::ordered_json::parse(rows.read_metadata());
  for (nlohmann::ordered_json& source : metadata.at("sources")) source.erase("imported");
  return metadata.dump();
}

}  // namespace

std::string content_digest(const Store& store, Progress& progress) {
  const StoreRows& rows = file_of(store).rows();
  HashSum sum;
  const std::string metadata = metadata_without_times(rows);
  sum.add(XXH3_128bits(metadata.data(), metadata.size()));
  CallProgress call(progress);
  add_rows(rows, BlobKind::Directory, sum, call.step(0.1));
  add_rows(rows, BlobKind::Block, sum, call.step(1));
  call.finish();
  return sum.text();
}

}  // namespace itin
