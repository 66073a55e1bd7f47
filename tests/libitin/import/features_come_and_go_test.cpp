// Features come to a store and leave it, and its ground stays byte for byte: the store is always the one that an import
// of all that it has would make from scratch, to the last byte of the file.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <random>
#include <string>
#include <sys/resource.h>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>

#include "support/forged_rows.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::LineFeature;

/// One file of features, or one of terrain, and how it is imported.
struct ImportedFile {
  std::string file;
  ImportOptions options;
};

std::string whole_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string digest_of_file(const std::string& store) {
  NoProgress progress;
  return content_digest(Store(store), progress);
}

class FeaturesComeAndGo : public testing::Test {
 protected:
  FeaturesComeAndGo() { ::setenv("SOURCE_DATE_EPOCH", "1700000000", 1); }
  ~FeaturesComeAndGo() override { ::unsetenv("SOURCE_DATE_EPOCH"); }

  std::string path(const std::string& name) const { return directory_.file(name); }
  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 1000000) / 1e6; }
  bool chance(unsigned of) { return random_() % of == 0; }

  /// Rolling ground of 900 m, mostly with a void.
  ImportedFile ground(const std::string& file, double step, double size, Point2 corner) {
    const double x = in(0, size), y = in(0, size), phase = in(0, 6);
    const int posts = static_cast<int>(size / step);
    test::write_raster(path(file), {corner.x, corner.y, step, posts, posts, 27700}, [&](int c, int r) {
      if (std::hypot(c * step - x, r * step - y) < 2 * step) return std::nan("");
      return 100 + 20 * std::sin(c * step / 170 + phase) + 15 * std::cos(r * step / 130) + in(-0.3, 0.3);
    });
    ImportedFile source{file, {}};
    source.options.sources = {path(file)};
    return source;
  }

  /// A file of features in a box, some beyond the ground, with fields that not every file has.
  ImportedFile features(const std::string& file, ThemeKind kind, const std::string& theme, int count, double side,
                        const Box& box) {
    std::vector<LineFeature> features;
    for (int i = 0; i < count; ++i) {
      LineFeature f = test::turned_box({in(box.xmin, box.xmax), in(box.ymin, box.ymax)}, in(3, side), in(3, side),
                                       in(0, 1.5), in(2, 30));
      if (kind == ThemeKind::Walls) f.vertices.resize(2), f.polygon = false;
      f.properties = fmt::format(R"({{"h":{:.1f},"{}":{},"all":"{}"}})", in(2, 30), fields_[random_() % fields_.size()],
                                 chance(3) ? "1.5" : "7", random_() % 100);
      features.push_back(f);
    }
    test::write_lines(path(file), features);
    ImportedFile source{file, {}};
    source.options.sources = {path(file)};
    source.options.kind = kind;
    source.options.theme = theme;
    source.options.height_field = "h";
    if (kind == ThemeKind::Buildings && chance(3)) source.options.foundation = Foundation::flat;
    if (kind == ThemeKind::Buildings && chance(3)) source.options.roof = RoofKind::hipped;
    return source;
  }

  /// A raster of a wood, of whose cells some are too low to stand.
  ImportedFile canopy(const std::string& file) {
    test::write_raster(path(file), {in(300050, 300500), in(199500, 199900), in(4, 9), 10, 9, 27700},
                       [&](int, int) { return chance(9) ? std::nan("") : in(-3, 25); });
    ImportedFile source{file, {}};
    source.options.sources = {path(file)};
    source.options.kind = ThemeKind::Vegetation;
    source.options.theme = "canopy";
    source.options.height_step = 4;
    return source;
  }

  /// Files of features that touch each other within and across themes.
  std::vector<ImportedFile> random_features(const Box& box, double side) {
    return {features("a.geojson", ThemeKind::Buildings, "houses", 8, side, box),
            features("b.geojson", ThemeKind::Buildings, "houses", 5, side, box),
            features("c.geojson", ThemeKind::Buildings, "houses", 1, side / 3, box),
            features("d.geojson", ThemeKind::Buildings, "sheds", 4, side / 2, box),
            features("e.geojson", ThemeKind::Walls, "walls", 9, 2 * side, box),
            features("f.geojson", ThemeKind::Walls, "walls", 4, 3 * side, box),
            features("g.geojson", ThemeKind::Vegetation, "woods", 3, 3 * side, box),
            features("h.geojson", ThemeKind::Vegetation, "woods", 2, 2 * side, box),
            features("i.geojson", ThemeKind::Terraces, "rows", 3, side, box)};
  }

  ImportReport import(const std::string& store, const ImportedFile& source) {
    NoProgress progress;
    return source.options.kind ? import_lines(path(store), source.options, progress)
                               : import_terrain(path(store), source.options, progress);
  }

  ImportReport remove(const std::string& store, const std::string& name) {
    ImportOptions options;
    options.remove = {name};
    NoProgress progress;
    return import_terrain(path(store), options, progress);
  }

  /// Makes a store of these sources in a random order. The ground comes last but for the first piece of it, so that all
  /// features are put on it in the way that makes the ground, too.
  void make_from_scratch(const std::string& store, const std::vector<ImportedFile>& ground,
                         std::vector<ImportedFile> features) {
    std::filesystem::remove(path(store));
    import(store, ground.front());
    std::shuffle(features.begin(), features.end(), random_);
    for (const ImportedFile& source : features) import(store, source);
    for (std::size_t i = 1; i < ground.size(); ++i) import(store, ground[i]);
  }

  /// Compares a store that features have come to and left with one from scratch; `way` tells how it came about.
  void expect_as_from_scratch(const std::string& store, const std::vector<ImportedFile>& ground,
                              const std::vector<ImportedFile>& features, const std::string& way) {
    make_from_scratch("scratch.itin", ground, features);
    EXPECT_EQ(digest_of_file(path(store)), digest_of_file(path("scratch.itin"))) << way;
    EXPECT_TRUE(whole_file(path(store)) == whole_file(path("scratch.itin"))) << way;
    NoProgress progress;
    for (const Damage& damage : check(Store(path(store)), progress))
      ADD_FAILURE() << damage.place << ": " << damage.what << way;
  }

  /// Lets features come and go at random, twenty times, and compares every few steps.
  void let_come_and_go(const std::vector<ImportedFile>& ground, std::vector<ImportedFile> absent, int steps_between) {
    std::filesystem::remove(path("store.itin"));
    for (const ImportedFile& source : ground) import("store.itin", source);
    std::vector<ImportedFile> present;
    std::string way;
    for (int step = 1; step <= 20; ++step) {
      const bool comes = present.empty() || (!absent.empty() && !chance(3));
      std::vector<ImportedFile>&from = comes ? absent : present, &to = comes ? present : absent;
      const std::size_t which = random_() % from.size();
      const ImportedFile source = from[which];
      from.erase(from.begin() + static_cast<std::ptrdiff_t>(which));
      to.push_back(source);
      way += (comes ? " + " : " - ") + source.file;
      const ImportReport report = comes ? import("store.itin", source) : remove("store.itin", source.file);
      EXPECT_EQ(report.ground_made_again, "") << way;
      EXPECT_EQ(report.removed > 0, !comes) << way;
      if (step % steps_between == 0) expect_as_from_scratch("store.itin", ground, present, way);
      if (HasFailure()) return;
    }
  }

  std::mt19937 random_{test::seed()};
  const std::vector<std::string> fields_{"storeys", "year", "use"};
  test::TemporaryDirectory directory_;
};

TEST_F(FeaturesComeAndGo, AsInAnImportFromScratch) {
  for (int world = 0; world < 3 && !HasFailure(); ++world) {
    std::vector<ImportedFile> sources = random_features({300030, 199130, 300900, 199980}, 60);
    sources.push_back(canopy("j.tif"));
    let_come_and_go({ground("ground.tif", 50, 900, {300000, 200000}), ground("fine.tif", 10, 300, {300205, 199855})},
                    sources, 5);
  }
}

TEST_F(FeaturesComeAndGo, AsInAnImportFromScratchOnRealTerrain) {
  ImportedFile real{"alexandria-dtm.tif", {}}, houses{"alexandria-buildings.geojson", {}};
  real.options.sources = {std::string(ITIN_SOURCE_DIR) + "/scripts/demo-data/" + real.file};
  houses.options.sources = {std::string(ITIN_SOURCE_DIR) + "/scripts/demo-data/" + houses.file};
  houses.options.kind = ThemeKind::Buildings;
  houses.options.theme = "houses";
  houses.options.height_field = "HEIGHT";
  std::vector<ImportedFile> sources = random_features({321500, 4297500, 322040, 4298000}, 40);
  for (ImportedFile& source : sources) source.options.crs = "EPSG:26918";
  sources.push_back(houses);
  // A piece that is imported last has the same posts, so that the store from scratch makes its ground again.
  let_come_and_go({real, real}, sources, 10);
}

/// Stops at the n-th look.
struct StoppingAt final : Progress {
  explicit StoppingAt(int n) : left(n) {}
  void report(std::string_view, double) override {}
  bool cancelled() const override { return --left < 0; }
  mutable std::atomic<int> left;
};

TEST_F(FeaturesComeAndGo, OrLeaveTheStoreAsItWasWhereTheyAreStopped) {
  const std::string store = path("store.itin");
  import("store.itin", ground("ground.tif", 20, 900, {300000, 200000}));
  import("store.itin", features("a.geojson", ThemeKind::Buildings, "houses", 20, 30, {300030, 199130, 300900, 199980}));
  const std::string before = whole_file(store);
  const ImportedFile more = features("b.geojson", ThemeKind::Walls, "walls", 20, 30, {300030, 199130, 300900, 199980});
  StoppingAt never(1 << 30);
  std::filesystem::copy_file(store, path("copy.itin"));
  import_lines(path("copy.itin"), more.options, never);
  const int looks = (1 << 30) - never.left;
  ASSERT_GT(looks, 10);
  for (int at = 0; at < looks; at += std::max(1, looks / 40)) {
    StoppingAt progress(at);
    EXPECT_THROW(import_lines(store, more.options, progress), Cancelled) << at << " of " << looks;
    EXPECT_TRUE(whole_file(store) == before);
    EXPECT_FALSE(std::filesystem::exists(store + ".writing"));
  }
}

/// Stands for a full disk: writes beyond the limit fail.
class CutOffDisk {
 public:
  explicit CutOffDisk(std::uint64_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~CutOffDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  CutOffDisk(const CutOffDisk&) = delete;

 private:
  rlimit before_{};
};

TEST_F(FeaturesComeAndGo, OrLeaveTheStoreAsItWasWhereTheDiskIsFull) {
  const std::string store = path("store.itin");
  import("store.itin", ground("ground.tif", 10, 900, {300000, 200000}));
  const std::string before = whole_file(store);
  const ImportedFile more = features("b.geojson", ThemeKind::Walls, "walls", 20, 30, {300030, 199130, 300900, 199980});
  for (const double share : {0.0, 0.3, 0.8, 1.0}) {
    const CutOffDisk full(static_cast<std::uint64_t>(share * static_cast<double>(before.size())));
    EXPECT_THROW(import("store.itin", more), FileError) << share;
    EXPECT_TRUE(whole_file(store) == before);
    EXPECT_FALSE(std::filesystem::exists(store + ".writing"));
  }
}

TEST_F(FeaturesComeAndGo, ButNotOnDamagedGround) {
  const std::string store = path("store.itin");
  import("store.itin", ground("ground.tif", 10, 900, {300000, 200000}));
  test::execute_sql(store,
                    "UPDATE block SET data = substr(data, 1, length(data) - 1) WHERE key = (SELECT key FROM block "
                    "ORDER BY key LIMIT 1 OFFSET 2)");
  const std::string before = whole_file(store);
  const ImportedFile more = features("b.geojson", ThemeKind::Walls, "walls", 5, 30, {300400, 199400, 300500, 199500});
  EXPECT_THROW(import("store.itin", more), CorruptStore);
  EXPECT_TRUE(whole_file(store) == before);
}

TEST_F(FeaturesComeAndGo, OnGroundThatIsMadeAgainWhereLinesLieOnIt) {
  import("store.itin", ground("ground.tif", 20, 900, {300000, 200000}));
  const ImportedFile houses =
      features("a.geojson", ThemeKind::Buildings, "houses", 6, 30, {300030, 199130, 300900, 199980});
  EXPECT_EQ(import("store.itin", houses).ground_made_again, "");
  ImportedFile outlines = features("b.geojson", ThemeKind::Walls, "outlines", 6, 90, {300030, 199130, 300900, 199980});
  outlines.options.height_field.clear();
  EXPECT_EQ(import("store.itin", outlines).ground_made_again, "lines on the ground are added");
  EXPECT_EQ(remove("store.itin", "houses").ground_made_again, "lines lie on it");
  import("other.itin", ground("ground.tif", 20, 900, {300000, 200000}));
  EXPECT_EQ(import("other.itin", ground("more.tif", 20, 300, {300100, 199900})).ground_made_again, "terrain is added");
}

TEST_F(FeaturesComeAndGo, OneThemeInThePlaceOfAnother) {
  const ImportedFile hill = ground("ground.tif", 20, 900, {300000, 200000});
  std::vector<ImportedFile> sources = random_features({300030, 199130, 300900, 199980}, 60);
  for (int twice = 0; twice < 2; ++twice) import("store.itin", hill);
  for (const ImportedFile& source : sources) import("store.itin", source);
  ImportedFile instead =
      features("instead.geojson", ThemeKind::Walls, "houses", 5, 40, {300030, 199130, 300900, 199980});
  instead.options.remove = {"houses", "g.geojson"};
  instead.options.wall_offset = 0.3;
  EXPECT_EQ(import("store.itin", instead).removed, 8U + 5 + 1 + 3);
  std::erase_if(sources, [](const ImportedFile& s) { return s.options.theme == "houses" || s.file == "g.geojson"; });
  instead.options.remove.clear();
  sources.push_back(instead);
  expect_as_from_scratch("store.itin", {hill, hill}, sources, "a theme in place of another");
}

TEST_F(FeaturesComeAndGo, ButNoneThatIsNotNamed) {
  import("store.itin", ground("ground.tif", 20, 900, {300000, 200000}));
  const auto refusal = [&](const std::string& name) -> std::string {
    try {
      remove("store.itin", name);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(refusal("houses"), testing::HasSubstr("it has none at all"));
  import("store.itin", features("a.geojson", ThemeKind::Buildings, "houses", 6, 30, {300030, 199130, 300900, 199980}));
  const std::string before = whole_file(path("store.itin"));
  EXPECT_THAT(refusal("ground.tif"), testing::HasSubstr("it has a.geojson, houses"));
  ImportOptions useless;
  useless.remove = {"houses"};
  useless.height = 3;
  NoProgress progress;
  EXPECT_THROW(import_terrain(path("store.itin"), useless, progress), InputError);
  EXPECT_TRUE(whole_file(path("store.itin")) == before);
  useless.height.reset();
  EXPECT_THROW(import_terrain(path("none.itin"), useless, progress), InputError);
  EXPECT_FALSE(std::filesystem::exists(path("none.itin")));
}

}  // namespace
}  // namespace itin
