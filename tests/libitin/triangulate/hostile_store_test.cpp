// Stores that no import writes: lines that cross each other, and lines whose ends are no vertices.
#include <atomic>
#include <string_view>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "libitin/store/random_points.hpp"
#include "support/impatient.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

class HostileStore : public testing::Test {
 protected:
  std::string path() const { return directory_.file("s.itin"); }

  test::TemporaryDirectory directory_;
};

TEST_F(HostileStore, IsTriangulatedOrRefused) {
  NoProgress progress;
  int done = 0, refused = 0;
  for (std::uint64_t i = 0; i < 30; ++i) {
    test::random_store(test::seed() + i, 20 << i % 8, 3).write(path());
    const Store store(path());
    for (const double tolerance : {0.0, 1.0, 2.0}) {
      try {
        triangulate(store, Window::all(), Detail::tolerance(tolerance), progress);
        ++done;
      } catch (const CorruptStore&) {
        throw;  // every byte of it is as it was written
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 10) << done;
}

TEST_F(HostileStore, CanBeLeftInTheMidstOfATile) {
  test::GivenStore given = test::random_store(test::seed(), 20000, 1);
  given.segments.clear();
  given.write(path());
  const Store store(path());
  const auto triangulated = [&](Progress& progress) {
    return triangulate(store, Window::all(), Detail::tolerance(0), progress);
  };
  test::Impatient patient(1 << 30);
  triangulated(patient);
  EXPECT_GT(patient.asked(), 50);
  for (int looks = 0; looks < patient.asked(); looks += 1 + patient.asked() / 20) {
    test::Impatient impatient(looks);
    EXPECT_THROW(triangulated(impatient), Cancelled) << looks;
  }
}

}  // namespace
}  // namespace itin
