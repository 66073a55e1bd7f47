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

std::optional<CertifiedError> Store::certified_error(int level, const Box& box) const {
  return file_->certified_error(level, box);
}
std::uint64_t Store::points_about(int level, const Box& box) const {
  return file_->points_about(level, box);
}
Certificate Store::certificate(int level, const Box& box) const {
  return file_->certificate(level, box);
}

}  // namespace itin
