#include "job/runner_name.hpp"

#include <algorithm>
#include <random>
#include <unistd.h>

#include <fmt/format.h>

namespace itin::viewshed {

namespace {

std::string drawn_name() {
  char host[256] = "";
  if (::gethostname(host, sizeof host - 1) != 0) host[0] = '\0';
  std::string name =
      fmt::format("{}.{}.{:08x}", host[0] == '\0' ? "machine" : host, ::getpid(), std::random_device()());
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

}  // namespace

std::string runner_name() {
  static const std::string kName = drawn_name();
  return kName;
}

}  // namespace itin::viewshed
