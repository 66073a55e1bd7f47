#include "viewshed/hidden_eyes.hpp"

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/cross_section.hpp>

namespace itin::cli {

void warn_of_hidden_eyes(const Store& store, const viewshed::Result& result, const Detail& detail,
                         std::vector<std::string>& warnings) {
  const viewshed::Request& request = result.request;
  const StoreMetadata& metadata = store.metadata();
  if (request.observers_on_surface || !request.themes.includes_raised(metadata.themes)) return;
  std::size_t count = 0;
  std::string first;
  for (std::size_t i = 0; i < request.observers.size(); ++i) {
    const viewshed::Observer& observer = request.observers[i];
    const CrossSection above = cross_section(store, observer.position, observer.position, detail, request.themes);
    if (above.breakpoints.empty() || above.breakpoints.front().theme == 0) continue;
    const Breakpoint& top = above.breakpoints.front();
    const double eye = observer.height + (observer.absolute ? 0 : result.ground_m[i]), below = top.position.z - eye;
    if (below <= 0) continue;
    if (count++ == 0)
      first = fmt::format("{:.10g},{:.10g} is within {}, {:.1f} m below the top", observer.position.x,
                          observer.position.y, metadata.themes[top.theme - std::size_t{1}].name, below);
  }
  if (count == 0) return;
  warnings.push_back(
      fmt::format("{} within a feature and lower than its top, and can see no place but its own: the eye at {}; to "
                  "stand on top give "
                  "--observer-on surface, to leave features out --themes",
                  count == 1 ? "1 observer is" : counted(count, "observer") + " are each", first));
}

}  // namespace itin::cli
