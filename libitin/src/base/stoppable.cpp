#include "base/stoppable.hpp"

#include <utility>

namespace itin {

namespace {

thread_local const Progress* current = nullptr;

}  // namespace

Stoppable::Stoppable(const Progress* progress) : before_(std::exchange(current, progress)) {}

Stoppable::~Stoppable() {
  current = before_;
}

const Progress* stopper() {
  return current;
}

}  // namespace itin
