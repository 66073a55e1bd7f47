#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/cross_section.hpp>
#include <viewshed/hidden_eyes.hpp>

namespace itin::viewshed {

std::optional<Cover> cover_at(const Store& store, Point2 place, const Detail& detail, const ThemeChoice& themes) {
  const StoreMetadata& metadata = store.metadata();
  if (!themes.includes_raised(metadata.themes)) return std::nullopt;
  const CrossSection above = cross_section(store, place, place, detail, themes);
  if (above.breakpoints.empty() || above.breakpoints.front().theme == 0) return std::nullopt;
  const Breakpoint& top = above.breakpoints.front();
  return Cover{metadata.themes[top.theme - std::size_t{1}].name, top.position.z};
}

void warn_of_hidden_eyes(const Store& store, const Eyes& eyes, std::vector<std::string>& warnings) {
  std::size_t count = 0;
  std::string first;
  for (const Point3& eye : eyes.places) {
    const auto cover = cover_at(store, {eye.x, eye.y}, eyes.detail, eyes.themes);
    if (!cover || eye.z >= cover->top) continue;
    if (count++ == 0)
      first = fmt::format("{:.10g},{:.10g} is within {}, {:.1f} m below the top", eye.x, eye.y, cover->theme,
                          cover->top - eye.z);
  }
  if (count == 0) return;
  warnings.push_back(fmt::format(
      "{} within a feature and lower than its top, and can see no place but its own: the eye at {}; to stand on top "
      "give `on_surface`, to leave features out `themes`",
      count == 1 ? fmt::format("1 {} is", eyes.what) : counted(count, eyes.what) + " are each", first));
}

}  // namespace itin::viewshed
