// What is written of results that have their cells part by part, from the answers of tasks, is what is written of those
// that hold them.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/byte_archive.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/qgis_styles.hpp>
#include <viewshed/result_raster.hpp>
#include <viewshed/tasks.hpp>
#include <viewshed/viewshed.hpp>

#include "support/file_bytes.hpp"
#include "support/hills_and_town.hpp"
#include "support/seed.hpp"

namespace itin::viewshed {
namespace {

class CellsByParts : public testing::Test {
 protected:
  static void SetUpTestSuite() { landscapes_ = new test::HillsAndTown; }
  static void TearDownTestSuite() {
    delete landscapes_;
    landscapes_ = nullptr;
  }

  /// Answers all tasks, and puts the answers together the last one first.
  static auto put_together(auto& tasks, std::vector<std::string>& answers) {
    NoProgress progress;
    for (std::size_t i = 0; i < tasks.list().size(); ++i) answers.push_back(tasks.answer(i, progress));
    EXPECT_GT(answers.size(), 2U);
    tasks.read_again_by([&](std::size_t task) { return answers.at(task); });
    for (std::size_t i = answers.size(); i-- > 0;) tasks.add(i, answers[i]);
    return tasks.take();
  }
  std::string raster(const Store& store, const Result& result) {
    const std::string path = landscapes_->file("seen.tif");
    write_result_raster(path, result, store.metadata(), {.certified = result.certified, .overwrite = true}, progress_);
    return test::file_bytes(path);
  }
  /// The document, less the statistics, which tell how much was read.
  static Document document(const Store& store, const Result& result) {
    Document document = viewshed_document(store.metadata(), result);
    document.erase("statistics");
    return document;
  }

  void expect_same(const Store& store, const Request& request, std::uint64_t most_cells,
                   Certainty certainty = Certainty::kExact) {
    SCOPED_TRACE(static_cast<int>(request.mode));
    const Result whole = certainty == Certainty::kExact ? compute(store, request, progress_)
                                                        : compute_certified(store, request, {}, progress_).result;
    ViewshedTasks tasks(store, request, {}, most_cells, certainty);
    std::vector<std::string> answers;
    const Result merged = put_together(tasks, answers);
    if (request.mode == Mode::kBlocker) {
      EXPECT_FALSE(merged.parts);
    } else {
      EXPECT_TRUE(merged.parts);
      EXPECT_TRUE(merged.visible.empty());
    }
    EXPECT_TRUE(raster(store, merged) == raster(store, whole));
    EXPECT_EQ(document(store, merged), document(store, whole));
    EXPECT_EQ(qgis_style(merged), qgis_style(whole));
    const MissingGround of_whole = missing_ground(store, whole, progress_),
                        of_merged = missing_ground(store, merged, progress_);
    EXPECT_EQ(of_merged.without_ground, of_whole.without_ground);
    EXPECT_EQ(of_merged.with_ground, of_whole.with_ground);
    EXPECT_EQ(of_merged.beyond, of_whole.beyond);
    missing_ += of_whole.without_ground;
    if (!merged.parts) return;
    answers.back().pop_back();
    EXPECT_THROW(raster(store, merged), NotThoseValues);
  }

  static inline test::HillsAndTown* landscapes_ = nullptr;
  NoProgress progress_;
  std::uint64_t missing_ = 0;
};

TEST_F(CellsByParts, OfViewshedsInEveryMode) {
  const Store hills(landscapes_->hills()), town(landscapes_->town());
  for (const Mode mode : test::kEveryMode) {
    expect_same(hills, test::HillsAndTown::in_mode(mode, test::HillsAndTown::over_hills()), 20000);
    expect_same(town, test::HillsAndTown::in_mode(mode, test::HillsAndTown::over_town()), 8000);
  }
}

/// Rasters with overviews, and observers that see the cells of few tasks.
TEST_F(CellsByParts, OfLargerRastersAndManyObservers) {
  const Store hills(landscapes_->hills());
  Request request = test::HillsAndTown::over_hills();
  request.cell_size = 6;
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> along(1700, 3900);
  while (request.observers.size() < 40) {
    Observer observer{std::to_string(request.observers.size()), {300000 + along(random), 200000 + along(random)}, 10};
    observer.radius = 400;
    request.observers.push_back(observer);
  }
  for (const Mode mode : {Mode::kVisible, Mode::kCount, Mode::kWhich, Mode::kNearest}) {
    request.mode = mode;
    expect_same(hills, request, 60000);
  }
}

TEST_F(CellsByParts, OfMissingGroundAndElevationsInView) {
  const Store hills(landscapes_->hills());
  Request request = test::HillsAndTown::over_hills();
  for (const NoData nodata : {NoData::kUnknown, NoData::kBlock, NoData::kClear}) {
    request.nodata = nodata;
    for (const Mode mode : {Mode::kVisible, Mode::kHeight}) {
      request.mode = mode;
      expect_same(hills, request, 9000);
    }
  }
  request.elevation = AngleRange{-4, 3};
  expect_same(hills, request, 9000);
  EXPECT_GT(missing_, 100U);
}

TEST_F(CellsByParts, OfWhatIsCertain) {
  const Store hills(landscapes_->hills());
  Request request = test::HillsAndTown::over_hills();
  request.detail = Detail::tolerance(4);
  expect_same(hills, request, 6000, Certainty::kCertified);
}

TEST_F(CellsByParts, OfHowMuchIsSeen) {
  const Store hills(landscapes_->hills());
  for (const bool rays : {true, false}) {
    SCOPED_TRACE(rays);
    IndexRequest request;
    request.area = Window::all();
    request.cell_size = 60, request.radius = 900, request.height = 5;
    if (!rays) request.targets = 40;
    const VisibilityIndex whole = visibility_index(hills, request, progress_);
    EXPECT_EQ(whole.sample.rays > 0, rays);
    IndexTasks tasks(hills, request, 300, progress_);
    std::vector<std::string> answers;
    const VisibilityIndex merged = put_together(tasks, answers);
    ASSERT_TRUE(merged.parts);
    EXPECT_TRUE(merged.share.empty());
    EXPECT_EQ(merged.mean, whole.mean);
    EXPECT_EQ(merged.mean_error, whole.mean_error);
    EXPECT_EQ(merged.mean_undecided, whole.mean_undecided);
    EXPECT_EQ(merged.ground, whole.ground);
    EXPECT_EQ(merged.observers, whole.observers);
    const std::string path = landscapes_->file("index.tif");
    const auto written = [&](const VisibilityIndex& index) {
      write_geotiff(path, index, request, {hills.metadata().crs_wkt, {}, true}, progress_);
      return test::file_bytes(path);
    };
    EXPECT_TRUE(written(merged) == written(whole));
    // A plain sum over the cells, one after the other.
    double sum = 0;
    for (const float share : whole.share) sum += std::isnan(share) ? 0 : share;
    EXPECT_NEAR(whole.mean, sum / static_cast<double>(whole.observers), 1e-12);
    answers.front().pop_back();
    EXPECT_THROW(written(merged), NotThoseValues);
  }
}

}  // namespace
}  // namespace itin::viewshed
