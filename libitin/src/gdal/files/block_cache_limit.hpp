// How much memory GDAL's cache of blocks may take.
#pragma once

#include <algorithm>
#include <cstdint>

#include <gdal_priv.h>

namespace itin {

/// Lends GDAL's cache of blocks, which the whole process shares, no more than this for as long as it lives.
class BlockCacheLimit {
 public:
  explicit BlockCacheLimit(std::uint64_t bytes) : before_(GDALGetCacheMax64()) {
    GDALSetCacheMax64(std::min(before_, static_cast<GIntBig>(bytes)));
  }
  ~BlockCacheLimit() { GDALSetCacheMax64(before_); }
  BlockCacheLimit(const BlockCacheLimit&) = delete;
  BlockCacheLimit& operator=(const BlockCacheLimit&) = delete;

 private:
  GIntBig before_;
};

}  // namespace itin
