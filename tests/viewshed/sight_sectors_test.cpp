// Every cell that an eye looks at is in one sector, and that holds the line to it.
#include "plan/sight_sectors.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/request.hpp>

#include "line/hulls.hpp"
#include "support/seed.hpp"

namespace itin::viewshed {
namespace {

constexpr double kAll = std::numeric_limits<double>::infinity();

class Sectors : public testing::Test {
 protected:
  static constexpr double kCell = 20;
  static constexpr std::int64_t kColumns = 150, kRows = 90;

  Eye eye_at(Point2 position, std::optional<double> radius) const {
    Request request;
    Observer observer;
    observer.position = position;
    observer.radius = radius;
    request.observers = {observer};
    return eye_of(Grid{{0, 0}, 0.01}, request, observer, 10);
  }

  /// How often each cell is decided, where hulls up to `largest` are taken to fit, and turn out to fit up to reach();
  /// those of single cells at least.
  void take_all(const Eye& eye, double largest, const std::function<double()>& reach, double least = kAll) {
    decided_.assign(grid_.cell_count(), 0);
    SightSectors sectors(grid_, eye);
    while (!sectors.empty()) {
      const SightSectors::Sector sector =
          sectors.next([&](const std::vector<Point2>& hull) { return area_of(hull) <= largest; });
      ASSERT_FALSE(sector.parts.empty());
      const Tile& last = sector.parts.back();
      const bool single = sector.parts.size() == 1 && last.columns * last.rows == 1;
      const double far = single ? least : reach();
      for (const Tile& part : sector.parts) {
        EXPECT_EQ(part.column / Tile::kSide, (part.column + part.columns - 1) / Tile::kSide);
        EXPECT_EQ(part.row / Tile::kSide, (part.row + part.rows - 1) / Tile::kSide);
        const bool within = sectors.within(far, part);
        for (std::int64_t r = part.row; r < part.row + part.rows; ++r) {
          for (std::int64_t c = part.column; c < part.column + part.columns; ++c) {
            const Point2 centre = grid_.centre(c, r);
            for (std::size_t i = 0; i < sector.hull.size(); ++i)
              EXPECT_GE(left_of(sector.hull[i], sector.hull[(i + 1) % sector.hull.size()], centre), 0);
            if (!within) continue;
            EXPECT_LT(std::max(std::abs(centre.x - eye.position.x), std::abs(centre.y - eye.position.y)), far);
            ++decided_[grid_.index({c, r})];
          }
        }
      }
      sectors.remove_decided(sector, far);
    }
  }

  const RasterGrid grid_{{5000, 9000}, kCell, kCell, kColumns, kRows};
  std::vector<int> decided_;
  std::mt19937 random_{test::seed()};
};

TEST_F(Sectors, HaveEveryCellOnce) {
  std::uniform_real_distribution<double> share(-0.3, 1.3), reach(0, 2 * kColumns * kCell);
  for (int i = 0; i < 20; ++i) {
    const Point2 position{5000 + share(random_) * kColumns * kCell, 9000 - share(random_) * kRows * kCell};
    const Eye eye = eye_at(position, std::nullopt);
    const double largest = std::exp2(10 + 10 * share(random_));
    int tries = 0;
    take_all(eye, largest, [&] { return ++tries % 3 == 0 ? kAll : reach(random_); });
    for (const int times : decided_) ASSERT_EQ(times, 1);
  }
}

TEST_F(Sectors, LeaveOutWhatIsTooFarAway) {
  const Point2 position{5000 + 40.5 * kCell, 9000 - 30.5 * kCell};
  const double radius = 25 * kCell;
  take_all(eye_at(position, radius), 1e5, [] { return kAll; });
  int looked_at = 0;
  for (std::size_t i = 0; i < decided_.size(); ++i) {
    const Point2 centre =
        grid_.centre(static_cast<std::int64_t>(i) % kColumns, static_cast<std::int64_t>(i) / kColumns);
    looked_at += decided_[i];
    EXPECT_LE(decided_[i], 1);
    if (std::hypot(centre.x - position.x, centre.y - position.y) <= radius) {
      EXPECT_EQ(decided_[i], 1);
    }
  }
  EXPECT_LT(looked_at, kColumns * kRows / 2);
}

TEST_F(Sectors, ASingleCellThatDoesNotFitIsRefused) {
  EXPECT_THROW(take_all(
                   eye_at({5000, 9000}, std::nullopt), 0, [] { return 0.0; }, 0),
               InputError);
}

TEST(AreaAndLength, OfATriangle) {
  const std::vector<Point2> ring{{0, 0}, {4, 0}, {4, 3}};
  EXPECT_EQ(area_of(ring), 6);
  EXPECT_EQ(length_of(ring), 12);
}

}  // namespace
}  // namespace itin::viewshed
