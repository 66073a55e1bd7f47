#include "job/runner_name.hpp"

#include <algorithm>
#include <unistd.h>

#include <fmt/format.h>

namespace itin::viewshed {

std::string runner_name() {
  char host[256] = "";
  if (::gethostname(host, sizeof host - 1) != 0) host[0] = '\0';
  std::string name = fmt::format("{}.{}", host[0] == '\0' ? "machine" : host, ::getpid());
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

}  // namespace itin::viewshed
