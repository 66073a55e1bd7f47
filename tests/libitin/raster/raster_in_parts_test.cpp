// A raster that comes in parts has the bytes of one that is written at once.
#include <algorithm>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/raster_in_parts.hpp>

#include "support/file_bytes.hpp"
#include "support/impatient.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

struct Rectangle {
  RasterGrid::Cell north_west;
  std::int64_t columns = 0, rows = 0;
};

class RastersInParts : public testing::Test {
 protected:
  std::int64_t from_to(std::int64_t least, std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(least, most)(random_);
  }

  /// Cuts a rectangle at random places into few or many.
  void cut(const Rectangle& all, std::vector<Rectangle>& parts) {
    const std::int64_t longer = std::max(all.columns, all.rows);
    if (longer < 2 || (longer < 600 && from_to(0, 1) == 0)) return parts.push_back(all);
    Rectangle first = all, second = all;
    if (all.columns >= all.rows) {
      first.columns = from_to(1, all.columns - 1);
      second.north_west.column += first.columns, second.columns -= first.columns;
    } else {
      first.rows = from_to(1, all.rows - 1);
      second.north_west.row += first.rows, second.rows -= first.rows;
    }
    cut(first, parts), cut(second, parts);
  }

  /// Returns the values of a rectangle, one band after the other.
  template <class T>
  static std::vector<T> values_of(const Rectangle& part, const RasterGrid& grid, const std::vector<T>& values) {
    std::vector<T> some;
    for (std::size_t band = 0; band < values.size() / grid.cell_count(); ++band)
      for (std::int64_t row = 0; row < part.rows; ++row) {
        const auto first = values.begin() +
                           static_cast<std::ptrdiff_t>(band * grid.cell_count() +
                                                       grid.index({part.north_west.column, part.north_west.row + row}));
        some.insert(some.end(), first, first + part.columns);
      }
    return some;
  }

  /// Leaves out a part now and then, of which all cells then have what stands for no value.
  template <class T>
  void expect_same_bytes(RasterDescription description, const std::function<T()>& draw, T none) {
    const RasterGrid grid({from_to(1, 9) * 1e5, 2e5}, 10, 10, from_to(1, 1400), from_to(1, 1400));
    std::vector<T> values(grid.cell_count() * (1 + description.further_bands.size()));
    std::generate(values.begin(), values.end(), draw);
    std::vector<Rectangle> parts;
    cut({{0, 0}, grid.columns(), grid.rows()}, parts);
    std::shuffle(parts.begin(), parts.end(), random_);
    if (parts.size() > 3) {
      const Rectangle left_out = parts.back();
      parts.pop_back();
      for (std::size_t i = 0; i < values.size(); ++i) {
        const auto cell = static_cast<std::int64_t>(i % grid.cell_count());
        const std::int64_t column = cell % grid.columns() - left_out.north_west.column,
                           row = cell / grid.columns() - left_out.north_west.row;
        if (column >= 0 && row >= 0 && column < left_out.columns && row < left_out.rows) values[i] = none;
      }
    }
    SCOPED_TRACE(testing::Message() << grid.columns() << " x " << grid.rows() << " in " << parts.size() << " parts");
    write_raster(directory_.file("whole.tif"), grid, std::span<const T>(values), description);
    RasterInParts<T> raster(directory_.file("parts.tif"), grid, description);
    for (const Rectangle& part : parts) {
      const std::vector<T> some = values_of(part, grid, values);
      raster.write(part.north_west, part.columns, part.rows, some);
    }
    raster.finish();
    EXPECT_TRUE(test::file_bytes(directory_.file("whole.tif")) == test::file_bytes(directory_.file("parts.tif")));
    EXPECT_EQ(directory_.names().size(), 2U) << "something is left beside the rasters";
  }

  static RasterDescription described() {
    RasterDescription description;
    description.crs_wkt = "";
    description.metadata = {{"made", "by a test"}, {"cells", "drawn at random"}};
    description.band_name = "values";
    description.overwrite = true;
    return description;
  }

  test::TemporaryDirectory directory_;
  std::mt19937 random_{test::seed()};
};

TEST_F(RastersInParts, HaveTheBytesOfClassesAtOnce) {
  RasterDescription description = described();
  description.nodata = 255;
  description.classes = {{0, "hidden", {10, 20, 30}}, {1, "visible", {200, 30, 40}}, {255, "outside", kTransparent}};
  for (int i = 0; i < 4; ++i)
    expect_same_bytes<std::uint8_t>(
        description, [&] { return std::uint8_t{from_to(0, 1) == 0}; }, 255);
}

TEST_F(RastersInParts, HaveTheBytesOfCountsAtOnce) {
  RasterDescription description = described();
  description.nodata = 65535;
  for (int i = 0; i < 4; ++i)
    expect_same_bytes<std::uint16_t>(
        description, [&] { return static_cast<std::uint16_t>(from_to(0, 300)); }, 65535);
}

TEST_F(RastersInParts, HaveTheBytesOfSetsAtOnce) {
  RasterDescription description = described();
  for (int i = 0; i < 3; ++i) {
    expect_same_bytes<std::uint32_t>(
        description, [&] { return static_cast<std::uint32_t>(random_()); }, 0);
    description.further_bands.emplace_back("more"), description.further_bands.emplace_back("most");
  }
}

TEST_F(RastersInParts, HaveTheBytesOfNumbersAtOnce) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  RasterDescription description = described();
  description.nodata = kNone;
  for (int i = 0; i < 3; ++i) {
    const auto draw = [&] { return from_to(0, 5) == 0 ? kNone : static_cast<float>(from_to(0, 1000000)) / 999; };
    expect_same_bytes<float>(description, draw, kNone);
    description.further_bands.emplace_back("more");
  }
}

/// Whose tiles would hold more than 64 MB, were they as large as others.
TEST_F(RastersInParts, HaveTheBytesOfManyBandsAtOnce) {
  RasterDescription description = described();
  description.further_bands.assign(69, "more");
  const RasterGrid grid({0, 0}, 5, 5, 150, 530);
  std::vector<std::uint32_t> values(grid.cell_count() * 70);
  for (std::size_t i = 0; i < values.size(); i += 3) values[i] = static_cast<std::uint32_t>(i);
  write_raster(directory_.file("whole.tif"), grid, std::span<const std::uint32_t>(values), description);
  RasterInParts<std::uint32_t> raster(directory_.file("parts.tif"), grid, description);
  raster.write({0, 0}, grid.columns(), grid.rows(), values);
  raster.finish();
  EXPECT_TRUE(test::file_bytes(directory_.file("whole.tif")) == test::file_bytes(directory_.file("parts.tif")));
}

TEST_F(RastersInParts, LeaveNothingUnlessFinished) {
  const RasterGrid grid({0, 0}, 5, 5, 700, 600);
  const std::vector<float> values(grid.cell_count(), 1);
  { RasterInParts<float>(directory_.file("a.tif"), grid, described()).write({0, 0}, 700, 600, values); }
  EXPECT_TRUE(directory_.names().empty());
  RasterInParts<float> raster(directory_.file("a.tif"), grid, described());
  raster.write({0, 0}, 700, 600, values);
  test::Impatient progress(1);
  EXPECT_THROW(raster.finish(progress), Cancelled);
  RasterDescription keeping = described();
  keeping.overwrite = false;
  std::ofstream(directory_.file("there.tif")) << "other";
  EXPECT_THROW(RasterInParts<float>(directory_.file("there.tif"), grid, keeping), FileError);
  EXPECT_THROW(RasterInParts<float>(directory_.file("no/folder.tif"), grid, keeping), FileError);
}

}  // namespace
}  // namespace itin
