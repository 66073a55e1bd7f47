#include <fmt/format.h>

#include <itin/level_choice.hpp>
#include <itin/surface_text.hpp>

namespace itin {

std::string surface_text(const StoreMetadata& metadata, const Detail& detail) {
  if (detail.coarsest() == 0) return "every stored point";
  std::string text = "tolerance ";
  if (detail.rings().size() == 1) {
    text += fmt::format("{:g} m", detail.coarsest());
  } else {
    for (const Ring& ring : detail.rings())
      text += fmt::format("{}{:g} m within {:g} m", &ring == &detail.rings().front() ? "" : ", ", ring.tolerance,
                          ring.radius);
  }
  const CertifiedError error = certified_error(metadata, detail);
  return text + fmt::format(", certified error {:+.2f} to {:+.2f} m", error.lo, error.hi);
}

}  // namespace itin
