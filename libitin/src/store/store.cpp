#include <algorithm>
#include <iterator>

#include <itin/certificate.hpp>
#include <itin/store.hpp>

#include "store/store_file.hpp"

namespace itin {

Store::Store(const std::string& path, const StoreOptions& options)
    : file_(std::make_unique<StoreFile>(path, options)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

const std::string& Store::path() const {
  return file_->rows().path();
}
const StoreMetadata& Store::metadata() const {
  return file_->metadata();
}
std::uint64_t Store::file_bytes() const {
  return file_->rows().file_bytes();
}
const PointIndex& Store::points() const {
  return *file_;
}

const StoreFile& file_of(const Store& store) {
  return static_cast<const StoreFile&>(store.points());
}

std::optional<CertifiedError> Store::certified_error(int level, const Box& box) const {
  return file_->certified_error(level, box);
}
std::uint64_t Store::points_about(int level, const Box& box) const {
  return file_->points_about(level, box);
}
Certificate Store::certificate(int level, const Box& box) const {
  return file_->certificate(level, box);
}

double Store::greatest_feature_height(const ThemeChoice& themes, const Box& box) const {
  return greatest_height_left_out(themes, std::numeric_limits<int>::max(), box);
}

double Store::greatest_height_left_out(const ThemeChoice& themes, int level, const Box& box) const {
  const StoreMetadata& store = metadata();
  std::int32_t greatest = 0;
  for (std::size_t p = 0; p < store.parts.size(); ++p) {
    if (store.parts[p].coarsest >= level) continue;
    if (!themes.includes(store.themes[store.parts[p].theme - std::size_t{1}])) continue;
    const auto number = static_cast<std::uint16_t>(store.themes.size() + p + 1);
    greatest = std::max(greatest, file_->greatest_height(number, store.grid.enclosing(box)));
  }
  return greatest * store.grid.resolution;
}

std::vector<StoredFootprint> stored_footprints(const Store& store, std::uint16_t theme, std::uint32_t block) {
  return store.file_->read_footprints(theme, block);
}

std::vector<StoredFootprint> stored_footprints(const Store& store, std::uint16_t theme) {
  std::vector<StoredFootprint> all;
  const std::uint32_t blocks = store.metadata().themes[theme - std::size_t{1}].footprint_blocks;
  for (std::uint32_t i = 0; i < blocks; ++i) {
    std::vector<StoredFootprint> some = stored_footprints(store, theme, i);
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace itin
