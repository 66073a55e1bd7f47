#include <fmt/format.h>

#include <viewshed/area_text.hpp>
#include <viewshed/undecided_area.hpp>

namespace itin::viewshed {

UndecidedArea undecided_area(const Zone& zone, const std::vector<std::uint16_t>& counts,
                             const std::vector<std::uint16_t>& undecided) {
  std::uint64_t any = 0, more = 0;
  for (std::size_t i = 0; i < undecided.size(); ++i)
    if (counts[i] != kCountOutside && undecided[i] > 0) ++(counts[i] == 0 ? any : more);
  return {static_cast<double>(any) * zone.grid.cell_area(), static_cast<double>(more) * zone.grid.cell_area()};
}

std::string undecided_in_words(const UndecidedArea& tips) {
  std::string text;
  if (tips.any_m2 > 0) text = "whether a blade tip is visible from " + area_text(tips.any_m2);
  if (tips.more_m2 > 0)
    text += fmt::format("{}how many more are visible from {}", text.empty() ? "" : ", and ", area_text(tips.more_m2));
  return text;
}

}  // namespace itin::viewshed
