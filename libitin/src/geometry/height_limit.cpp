#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/height_limit.hpp>

namespace itin {

void require_height(double metres, std::string_view place) {
  if (is_height(metres)) return;
  throw InputError(
      fmt::format("{}: a height of {:g} m is beyond {:.0f} m, which no height may be; check its unit, or "
                  "what stands for missing heights",
                  place, metres, kFarthestHeight));
}

}  // namespace itin
