#include <algorithm>

#include <fmt/format.h>

#include <itin/feature_at.hpp>
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

std::string omitted_text(const ThemeChoice& themes) {
  constexpr std::size_t kMost = 8;
  const std::vector<OmittedFeature>& omitted = themes.omitted();
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, omitted.size()); ++i)
    text += fmt::format("{}{}, {}", i == 0 ? "without " : "; ", omitted[i].theme_name,
                        title_of({omitted[i].number, omitted[i].name, omitted[i].id}));
  return text + (omitted.size() > kMost ? fmt::format("; and {} more", omitted.size() - kMost) : "");
}

}  // namespace itin
