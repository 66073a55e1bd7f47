#include <algorithm>

#include "progress/stopwatch.hpp"
#include "run/surface_source.hpp"

namespace itin::viewshed {

std::optional<Result> run(SurfaceSource& source, const Request& request, const CellSink& sink, Progress& progress) {
  CallProgress call(progress);
  Result result;
  result.request = request;
  const std::vector<Eye> eyes = source.begin(result, call);
  ViewshedCells cells(result, sink, source.decides_all_cells(), call.step(1));
  const std::size_t most = source.eyes_at_once();
  for (std::size_t first = 0; first < eyes.size(); first += most) {
    call.throw_if_cancelled();
    const std::size_t end = std::min(eyes.size(), first + most);
    const EyeGroup group{std::span(eyes).subspan(first, end - first), static_cast<std::uint32_t>(first),
                         end == eyes.size()};
    if (!source.decide(group, cells)) return std::nullopt;
    cells.advance_past(end);
  }
  Stopwatch watch;
  cells.finish();
  result.statistics.lines_seconds += watch.lap();
  return result;
}

}  // namespace itin::viewshed
