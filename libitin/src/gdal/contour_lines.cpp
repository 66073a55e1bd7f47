#include <limits>

#include <gdal_alg.h>

#include <itin/contour_lines.hpp>
#include <itin/precondition.hpp>

namespace itin {

namespace {

/// What GDAL hands its lines to. It counts columns and rows from the grid's north-western corner.
struct ContourSink {
  const RasterGrid& grid;
  std::vector<std::vector<Point2>> lines;

  static CPLErr add(double /*level*/, int count, double* columns, double* rows, void* to) {
    auto& [grid, lines] = *static_cast<ContourSink*>(to);
    const Point2 corner = grid.north_west();
    std::vector<Point2>& line = lines.emplace_back();
    for (int i = count; i-- > 0;)  // GDAL has higher values on the right
      line.push_back({corner.x + columns[i] * grid.cell_width(), corner.y - rows[i] * grid.cell_height()});
    return CE_None;
  }
};

}  // namespace

std::vector<std::vector<Point2>> contour_lines(const RasterGrid& grid, std::span<const float> values, double level) {
  ITIN_PRECONDITION(values.size() == grid.cell_count());
  constexpr double kOneLevel = 1e30;  ///< the distance of the next level
  ContourSink sink{grid, {}};
  const GDALContourGeneratorH generator =
      GDAL_CG_Create(static_cast<int>(grid.columns()), static_cast<int>(grid.rows()), 1,
                     std::numeric_limits<double>::quiet_NaN(), kOneLevel, level, ContourSink::add, &sink);
  const auto columns = static_cast<std::size_t>(grid.columns());
  for (; !values.empty(); values = values.subspan(columns)) {
    std::vector<double> row(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(columns));
    GDAL_CG_FeedLine(generator, row.data());
  }
  GDAL_CG_Destroy(generator);  // which hands out the lines that are open still
  return std::move(sink.lines);
}

}  // namespace itin
