#include <filesystem>
#include <mutex>
#include <system_error>
#include <utility>

#include <itin/unfinished.hpp>

namespace itin {

namespace fs = std::filesystem;

namespace {

/// Attempts to remove a folder: a thread that still writes may fill it again during one.
constexpr int kTries = 100;

struct AllUnfinished {
  std::mutex mutex;
  std::list<const Unfinished*> list;  ///< the latest first
};

AllUnfinished& all() {
  static AllUnfinished all;
  return all;
}

}  // namespace

Unfinished::Lock::Lock() {
  all().mutex.lock();
}

Unfinished::Lock::~Lock() {
  all().mutex.unlock();
}

Unfinished::Unfinished(std::string path, Kind kind) : path_(std::move(path)), kind_(kind) {
  const Lock lock;
  place_ = all().list.insert(all().list.begin(), this);
}

Unfinished::~Unfinished() {
  const Lock lock;
  if (finished_) return;
  remove();
  keep();
}

void Unfinished::keep() {
  if (!std::exchange(finished_, true)) all().list.erase(place_);
}

void Unfinished::remove() const {
  std::error_code error;
  if (kind_ == Kind::folder) {
    for (int i = 0; i < kTries && (i == 0 || error); ++i) fs::remove_all(path_, error);
    return;
  }
  fs::remove(path_, error);
  if (kind_ == Kind::file) fs::remove(path_ + "-journal", error);
}

void remove_unfinished() {
  all().mutex.lock();
  for (const Unfinished* const unfinished : all().list) unfinished->remove();
}

}  // namespace itin
