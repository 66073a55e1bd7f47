// Diffraction against figures published by ITU-R Study Group 3 and its members, and against values worked by hand.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <profile/diffraction.hpp>

#include "published_profile.hpp"
#include "support/seed.hpp"

namespace itin::profile {

namespace {

using test::even_profile;
using test::published_profile;

RadioPath radio(double ghz, double earth_km, Polarisation polarisation = Polarisation::kHorizontal) {
  return {ghz, earth_km, polarisation, 0};
}

Antennas antennas_above(const Profile& profile, double from, double to) {
  return {profile.points.front().ground_m + from, profile.points.back().ground_m + to};
}

/// "Validation Examples for the delta Bullington diffraction prediction method", sheet "outputs": ae = 8500 km,
/// horizontal, over land. The sheet allows 0.1 dB; what is left here comes from its c = 3e8 m/s.
struct DeltaBullington {
  double from, to, ghz, above_t, above_r, lba, ldsph, ld;
};
constexpr double kPublished = 0.02;

void expect_published(const Profile& profile, const DeltaBullington& e) {
  const PathLosses losses = path_losses(profile, antennas_above(profile, e.from, e.to), radio(e.ghz, 8500));
  const Antennas ends = antennas_above(profile, e.from, e.to);
  EXPECT_NEAR(ends.from_m - losses.smooth.hstd_m, e.above_t, 1e-6);
  EXPECT_NEAR(ends.to_m - losses.smooth.hsrd_m, e.above_r, 1e-6);
  EXPECT_NEAR(losses.lba_db, e.lba, kPublished);
  EXPECT_NEAR(losses.ldsph_db, e.ldsph, kPublished);
  EXPECT_NEAR(losses.ld_db, e.ld, kPublished);
}

TEST(DeltaBullington, StudyGroup3Path4) {
  const Profile path = published_profile("sg3_path4");
  expect_published(path, {30, 30, 1.0, 139.8495825, 543.1729418, 7.8709851352, 0, 7.870985135});
  expect_published(path, {50, 10, 2.5, 159.8495825, 523.1729418, 0, 0, 0});
  expect_published(path, {20, 20, 0.6, 129.8495825, 533.1729418, 15.30876397, 0, 15.30876397});
  expect_published(path, {40, 50, 0.2, 149.8495825, 563.1729418, 6.526730443, 0, 6.526730443});
  expect_published(path, {70, 5, 0.15, 179.8495825, 518.1729418, 0, 0, 0});
}

TEST(DeltaBullington, StudyGroup3Path2) {
  const Profile path = published_profile("sg3_path2");
  expect_published(path, {30, 30, 1.0, 37.97366242, 119.2363492, 36.20419305, 69.45434151, 69.83036947});
  expect_published(path, {50, 10, 2.5, 57.97664284, 99.82603022, 44.81240928, 85.53863749, 90.68232743});
  expect_published(path, {20, 20, 0.6, 27.97366242, 109.2363492, 34.43917939, 66.31647651, 66.46062522});
  expect_published(path, {40, 50, 0.2, 47.97366242, 139.2363492, 28.37368149, 45.7547348, 46.38832061});
  expect_published(path, {70, 5, 0.15, 78.00115495, 99.67579634, 34.61746032, 43.35361839, 51.38547874});
}

/// P.1812 validation example "rburg_rural_with_clutter", as in eeveetza/Py1812, tests/validation_results/
/// rburg_rural_with_clutter_0_log.csv. Its Lbulla, Lbulls and Ldsph are those at three times the Earth's radius.
TEST(DeltaBullington, RegensburgToMunichWithClutter) {
  const Profile path = published_profile("rburg");
  const Antennas ends = antennas_above(path, 12, 19);
  const PathLosses median = path_losses(path, ends, radio(0.0982, 8930.776786));
  EXPECT_TRUE(median.horizons.trans_horizon);
  EXPECT_NEAR(*median.horizons.dlt_km, 0.5, 1e-9);
  EXPECT_NEAR(*median.horizons.dlr_km, 34.3, 1e-9);
  EXPECT_NEAR(median.horizons.theta_t_mrad, 45.93966178, 1e-6);
  EXPECT_NEAR(median.horizons.theta_r_mrad, -2.241021636, 1e-6);
  EXPECT_NEAR(median.smooth.hst_m, 408.6449283, 1e-6);
  EXPECT_NEAR(median.smooth.hsr_m, 496.8550717, 1e-6);
  EXPECT_NEAR(median.smooth.hstd_m, 362.5381701, 1e-6);
  EXPECT_NEAR(median.smooth.hsrd_m, 495.9202499, 1e-6);
  EXPECT_NEAR(median.ld_db, 72.68395376, 0.01);
  const PathLosses beta = path_losses(path, ends, radio(0.0982, 3 * 6371));
  EXPECT_NEAR(beta.lba_db, 47.56315628, 0.01);
  EXPECT_NEAR(beta.lbs_db, 16.1773341, 0.01);
  EXPECT_NEAR(beta.ldsph_db, 37.42847713, 0.01);
  EXPECT_NEAR(beta.ld_db, 68.81429931, 0.01);
}

TEST(KnifeEdge, HasTheValuesOfTheRecommendation) {
  // P.526-15 figure 9 and equation (31): grazing costs 6.02 dB by the approximation.
  EXPECT_NEAR(knife_edge_loss_db(0), 6.9 + 20 * std::log10(std::sqrt(1.01) - 0.1), 1e-12);
  EXPECT_NEAR(knife_edge_loss_db(0), 6.03, 0.01);
  EXPECT_NEAR(knife_edge_loss_db(1), 13.93, 0.01);
  EXPECT_NEAR(knife_edge_loss_db(2.4), 20.54, 0.02);
  EXPECT_EQ(knife_edge_loss_db(-0.78), 0);
  EXPECT_LT(knife_edge_loss_db(-0.7799), 0.03);
}

TEST(FreeSpace, IsTheWellKnownFormula) {
  // 92.4478 + 20 log f + 20 log d.
  EXPECT_NEAR(free_space_loss_db(1000, wavelength_m(1)), 92.4478, 1e-4);
  EXPECT_NEAR(free_space_loss_db(40000, wavelength_m(6)), 92.4478 + 20 * std::log10(240.0), 1e-4);
}

TEST(SingleEdge, IsBullingtonsOwnEdge) {
  // An edge 40 m above the chord at the middle of 10 km, 1 GHz, flat Earth: v = 40 sqrt(2 10000 / (lambda 5000^2)).
  const Profile path = even_profile(5000, {0, 60, 0});
  const RadioPath flat = radio(1, std::numeric_limits<double>::infinity());
  const double v = 40 * std::sqrt(2 * 10000 / (wavelength_m(1) * 5000 * 5000));
  const double single = 6.9 + 20 * std::log10(std::sqrt((v - 0.1) * (v - 0.1) + 1) + v - 0.1);
  EXPECT_NEAR(bullington_loss_db(path, {20, 20}, flat), single + (1 - std::exp(-single / 6)) * 10.2, 1e-9);
  // Both sub-paths of Deygout's edge are clear, so that only its correction is added.
  EXPECT_NEAR(deygout_loss_db(path, {20, 20}, flat), single + (1 - std::exp(-single / 6)) * 10.4, 1e-9);
}

TEST(Deygout, AddsTheEdgesOnEitherSide) {
  const Profile path = even_profile(2500, {0, 55, 80, 55, 0});
  const RadioPath flat = radio(1, std::numeric_limits<double>::infinity());
  const auto v_of = [](double above, double d1, double d2) {
    return above * std::sqrt(2 * (d1 + d2) / (wavelength_m(1) * d1 * d2));
  };
  const double main = knife_edge_loss_db(v_of(60, 5000, 5000)), side = knife_edge_loss_db(v_of(5, 2500, 2500));
  EXPECT_NEAR(deygout_loss_db(path, {20, 20}, flat), main + (1 - std::exp(-main / 6)) * (2 * side + 10.4), 1e-9);
}

TEST(Horizons, WithinSightTheyPointAtTheOtherAntenna) {
  const Profile path = even_profile(1000, {100, 90, 95, 80, 100});
  const RadioPath path_4_3 = radio(2, 8500);
  const Horizons seen = horizons(path, {130, 120}, path_4_3);
  EXPECT_FALSE(seen.trans_horizon);
  EXPECT_NEAR(seen.theta_t_mrad, 1000 * std::atan(-10.0 / 4000 - 4.0 / 17000), 1e-9);
  EXPECT_NEAR(seen.theta_r_mrad, 1000 * std::atan(10.0 / 4000 - 4.0 / 17000), 1e-9);
  EXPECT_NEAR(*seen.dlt_km, 2, 1e-12);  // the point of largest v
  EXPECT_NEAR(*seen.dlr_km, 2, 1e-12);
}

TEST(Clutter, CountsForLossesOnlyAndNotNearTheEnds) {
  Profile bare = even_profile(10, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  Profile near = bare, far = bare;
  near.points[4].clutter_m = near.points[6].clutter_m = 30;  // 40 m from each end
  const RadioPath path = radio(10, 8500);
  EXPECT_EQ(bullington_loss_db(near, {10, 10}, path), bullington_loss_db(bare, {10, 10}, path));
  far.points[5].clutter_m = 30;  // 50 m from both: not nearer than that
  EXPECT_GT(bullington_loss_db(far, {10, 10}, path), 10);
  EXPECT_EQ(horizons(far, {10, 10}, path).theta_t_mrad, horizons(bare, {10, 10}, path).theta_t_mrad);
  EXPECT_EQ(smooth_heights(far, {10, 10}).hstd_m, smooth_heights(bare, {10, 10}).hstd_m);
}

TEST(SphericalEarth, FallsToNothingWithHeight) {
  const RadioPath path = radio(1, 8500);
  EXPECT_EQ(spherical_earth_loss_db(20, 500, 500, path), 0);
  double before = spherical_earth_loss_db(60, 5, 5, path);
  for (double height = 10; height < 200; height += 5) {
    const double loss = spherical_earth_loss_db(60, height, height, path);
    EXPECT_LE(loss, before);
    before = loss;
  }
  EXPECT_EQ(before, 0);
  // The sea conducts vertical waves along it.
  RadioPath sea = radio(0.05, 8500, Polarisation::kVertical), land = sea;
  sea.over_sea = 1;
  EXPECT_LT(spherical_earth_loss_db(100, 10, 10, sea), spherical_earth_loss_db(100, 10, 10, land) - 10);
}

/// An antenna on the surface loses what one a hair above it does, wherever rounding has the reflection.
TEST(SphericalEarth, KnowsAnAntennaOnTheGround) {
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> kilometres(0.005, 40), metres(0.5, 300), gigahertz(0.1, 40), radius(6000, 9e4);
  for (int i = 0; i < 2000; ++i) {
    const RadioPath path = radio(gigahertz(random), radius(random));
    const double d = kilometres(random), height = metres(random);
    const double on_the_ground = spherical_earth_loss_db(d, height, 0, path);
    EXPECT_NEAR(on_the_ground, spherical_earth_loss_db(d, height, 1e-13, path), 0.01) << d << " km, " << height << " m";
    EXPECT_NEAR(on_the_ground, spherical_earth_loss_db(d, 0, height, path), 1e-6);
  }
}

TEST(PathLosses, AreTheSameFromEitherEnd) {
  const Profile path = published_profile("sg3_path4");
  const Antennas there = antennas_above(path, 12, 31), back{there.to_m, there.from_m};
  const PathLosses a = path_losses(path, there, radio(3, 7000)), b = path_losses(reversed(path), back, radio(3, 7000));
  EXPECT_NEAR(a.ld_db, b.ld_db, 1e-9);
  EXPECT_NEAR(a.deygout_db, b.deygout_db, 1e-9);
  EXPECT_NEAR(a.horizons.theta_t_mrad, b.horizons.theta_r_mrad, 1e-9);
  EXPECT_NEAR(a.smooth.hstd_m, b.smooth.hsrd_m, 1e-6);
}

TEST(PathLosses, RefuseWhatHasNoMeaning) {
  const Profile path = even_profile(1000, {0, 0, 0});
  EXPECT_THROW(path_losses(path, {10, 10}, radio(0, 8500)), InputError);
  EXPECT_THROW(path_losses(path, {10, -1}, radio(1, 8500)), InputError);
  EXPECT_THROW(path_losses(path, {10, 10}, radio(1, -1)), InputError);
  EXPECT_THROW(path_losses(even_profile(0, {0, 0}), {10, 10}, radio(1, 8500)), InputError);
}

TEST(WithSpacing, ChangesNoGround) {
  const Profile path = even_profile(1000, {0, 10, 5});
  const Profile dense = with_spacing(path, 300);
  ASSERT_EQ(dense.points.size(), 9U);
  EXPECT_EQ(dense.points[4].distance_m, 1000);
  EXPECT_NEAR(dense.points[2].ground_m, 5, 1e-12);
  EXPECT_NEAR(dense.points[6].ground_m, 7.5, 1e-12);
}

}  // namespace

}  // namespace itin::profile
