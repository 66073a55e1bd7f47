// Link budgets against figures that ITU-R Study Group 3 published, against those of other implementations, and against
// sums made by hand.
#include <cmath>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <profile/diffraction.hpp>
#include <profile/gas_loss.hpp>
#include <profile/multipath_fading.hpp>
#include <profile/rain_loss.hpp>

namespace itin::profile {

namespace {

/// "Validation examples for ITU-R Study Group 3 methods", sheet "P.676-13 SpAtt": 1013.25 hPa, 288.15 K, 7.5 g/m3.
TEST(GasLoss, StudyGroup3SpecificAttenuation) {
  const struct {
    double ghz, oxygen, water;
  } published[] = {{12, 0.00869826406877357, 0.00953538822024593},
                   {20, 0.0118835504778076, 0.0970473048151117},
                   {60, 14.6234747964861, 0.154841841},
                   {90, 0.0388697110724235, 0.341973394},
                   {130, 0.0415090835995228, 0.751844704}};
  for (const auto& e : published) {
    const GasLoss loss = gas_loss(e.ghz);
    EXPECT_NEAR(loss.oxygen_db_km, e.oxygen, 1e-6 * (1 + e.oxygen)) << e.ghz;
    EXPECT_NEAR(loss.water_db_km, e.water, 1e-6) << e.ghz;
    EXPECT_DOUBLE_EQ(loss.both_db_km(), loss.oxygen_db_km + loss.water_db_km);
  }
}

/// What crc-covlib's implementation of P.676-13 (commit bc72be0) gives for standard air, at the lines above 100 GHz:
/// the published figures say little of these.
TEST(GasLoss, AgreesWithAnotherImplementationUpTo1000Ghz) {
  const struct {
    double ghz, oxygen, water;
  } computed[] = {{118.75, 1.33395300732, 0.614975283007},  {120, 0.886108889994, 0.62986056492},
                  {183.31, 0.0127464731802, 28.0077201022}, {321.2, 0.0293793286998, 18.5163204522},
                  {325.15, 0.0301280067333, 37.9637351423}, {336.2, 0.0324618908686, 9.79153086598},
                  {368.5, 0.336178339936, 26.0964262862},   {380.2, 0.0493828221833, 299.851366155},
                  {390.1, 0.0494691182717, 37.4645009043},  {424.76, 3.29124551125, 21.3478188797},
                  {437.35, 0.114927985606, 61.0714966565},  {439.15, 0.10097058547, 83.1331947321},
                  {443.02, 0.0838953772551, 113.675655386}, {448, 0.0738090435807, 352.251863216},
                  {471, 0.0760676091736, 61.3343677584},    {474.69, 0.0859041013928, 84.4556745297},
                  {487.25, 1.48229060932, 53.1617325866},   {488.5, 0.985857024951, 55.4099296638},
                  {503.9, 0.0808945929335, 72.9249013747},  {547.7, 0.0753852097743, 1993.27001948},
                  {552, 0.0761517217946, 5359.43142781},    {556.94, 0.0770787488095, 17109.6261065},
                  {620.7, 0.0912470195612, 305.286918713},  {645.77, 0.0975893408405, 67.0666224249},
                  {658, 0.100924657617, 69.9647880381},     {715.39, 0.975373099694, 127.505197226},
                  {752.03, 0.156291050401, 11263.010539},   {773.84, 5.47720740343, 321.619839065},
                  {834.15, 2.18102590514, 80.3435571642},   {841.05, 0.249804039381, 79.8900051746},
                  {860, 0.161322405697, 83.5899871022},     {899.3, 0.163990476162, 104.862113245},
                  {902.6, 0.164690468553, 116.121515044},   {906.2, 0.165477120833, 141.108219812},
                  {916.17, 0.167752223823, 613.239207638},  {923.1, 0.169395884652, 180.813564688},
                  {970.3, 0.181273852429, 969.639467137},   {987.93, 0.185868629099, 8572.03614119},
                  {999, 0.188777107094, 796.071813204}};
  for (const auto& e : computed) {
    const GasLoss loss = gas_loss(e.ghz);
    EXPECT_NEAR(loss.oxygen_db_km / e.oxygen, 1, 1e-10) << e.ghz;
    EXPECT_NEAR(loss.water_db_km / e.water, 1, 1e-10) << e.ghz;
  }
}

TEST(GasLoss, DependsOnTheAir) {
  EXPECT_EQ(gas_loss(23, {.water_g_m3 = 0}).water_db_km, 0);
  EXPECT_NEAR(gas_loss(23, {.water_g_m3 = 15}).water_db_km / gas_loss(23).water_db_km, 2, 0.1);
  EXPECT_LT(gas_loss(60, {.dry_hpa = 800}).oxygen_db_km, gas_loss(60).oxygen_db_km);
}

/// P.838-3 table 5: k and alpha of horizontal and vertical polarisation.
TEST(RainLoss, CoefficientsOfTable5) {
  const struct {
    double ghz, kh, alpha_h, kv, alpha_v;
  } table[] = {{1, 0.0000259, 0.9691, 0.0000308, 0.8592},
               {10, 0.01217, 1.2571, 0.01129, 1.2156},
               {18, 0.07078, 1.0818, 0.07708, 1.0025},
               {80, 1.1704, 0.7115, 1.1668, 0.7021}};
  for (const auto& e : table) {
    const auto of = [&](Polarisation polarisation, double rate) {
      return rain_loss_db_km({.frequency_ghz = e.ghz, .polarisation = polarisation}, rate);
    };
    EXPECT_NEAR(of(Polarisation::kHorizontal, 1) / e.kh, 1, 1e-3) << e.ghz;
    EXPECT_NEAR(of(Polarisation::kVertical, 1) / e.kv, 1, 1e-3) << e.ghz;
    EXPECT_NEAR(std::log10(of(Polarisation::kHorizontal, 10) / e.kh), e.alpha_h, 1e-3) << e.ghz;
    EXPECT_NEAR(std::log10(of(Polarisation::kVertical, 10) / e.kv), e.alpha_v, 1e-3) << e.ghz;
  }
}

/// "Validation examples for ITU-R Study Group 3 methods", sheet "P.838-3 Sp.Att".
TEST(RainLoss, StudyGroup3SpecificAttenuation) {
  const struct {
    double elevation_deg, ghz, rate;
    Polarisation polarisation;
    double loss;
  } published[] = {{31.07699124, 14.25, 26.48052, Polarisation::kHorizontal, 1.58130839},
                   {52.67898486, 29, 78.2994993, Polarisation::kHorizontal, 13.59290086},
                   {48.24117054, 14.25, 63.62668149, Polarisation::kVertical, 3.72901264},
                   {20.14335809, 29, 42.91007183, Polarisation::kVertical, 6.83364556}};
  for (const auto& e : published) {
    const RainPath path{.frequency_ghz = e.ghz,
                        .polarisation = e.polarisation,
                        .elevation_rad = e.elevation_deg * std::acos(-1.0) / 180};
    EXPECT_NEAR(rain_loss_db_km(path, e.rate), e.loss, 1e-6) << e.ghz;
  }
}

struct RainCase {
  double km, ghz, rate;
  Polarisation polarisation;
  double specific, of_0_001, of_0_01, of_0_1, of_1;
};
/// What crc-covlib's implementation of P.530-18 (commit bc72be0) gives, with the rate given. That by I. Stevanovic
/// (eeveetza/p530) was read, and has the same formulas. ITU-Rpy takes the power of 0.8 in C0 of the logarithm, and
/// differs above 10 GHz.
constexpr RainCase kRain[] = {
    {9, 18, 28, Polarisation::kVertical, 2.1762187358, 26.96027645, 13.62112105, 5.16389522, 1.46898732},
    {20, 7.5, 42, Polarisation::kHorizontal, 0.6111083059, 12.54681975, 6.13837843, 2.33632717, 0.69178901},
    {3, 38, 60, Polarisation::kHorizontal, 14.7815279613, 69.39928353, 36.52588482, 13.77794985, 3.72483080},
    {1, 80, 32, Polarisation::kVertical, 13.2965276389, 33.35372747, 18.28443142, 6.86266335, 1.76351063},
    {45, 11, 25, Polarisation::kVertical, 0.7281572769, 27.92322715, 13.73253192, 5.22339006, 1.53663646},
    {0.5, 23, 28, Polarisation::kVertical, 3.1772309451, 6.94988487, 3.55869983, 1.34691611, 0.37681239}};

RainLoss rain_of(const RainCase& e) {
  return rain_loss({.frequency_ghz = e.ghz, .polarisation = e.polarisation, .length_km = e.km}, e.rate);
}

TEST(RainLoss, AgreesWithAnotherImplementation) {
  for (const RainCase& e : kRain) {
    const RainLoss rain = rain_of(e);
    EXPECT_NEAR(rain.specific_db_km, e.specific, 1e-8) << e.km;
    EXPECT_DOUBLE_EQ(rain.exceeded_db, rain.specific_db_km * rain.effective_km);
    EXPECT_NEAR(rain_exceeded_db(rain, e.ghz, 0.001), e.of_0_001, 1e-6) << e.km;
    EXPECT_NEAR(rain_exceeded_db(rain, e.ghz, 0.01), e.of_0_01, 1e-6) << e.km;
    EXPECT_NEAR(rain_exceeded_db(rain, e.ghz, 0.1), e.of_0_1, 1e-6) << e.km;
    EXPECT_NEAR(rain_exceeded_db(rain, e.ghz, 1), e.of_1, 1e-6) << e.km;
  }
  EXPECT_DOUBLE_EQ(rain_loss({.frequency_ghz = 23, .length_km = 0.3}, 28).effective_km, 2.5 * 0.3)
      << "short paths count 2.5 times at most";
}

/// The worked examples in the documentation of MATLAB's rainpl(), which has P.838-3 and P.530-17: 20 GHz over 10 km.
TEST(RainLoss, WorkedExamplesOfRainpl) {
  const RainPath path{.frequency_ghz = 20, .polarisation = Polarisation::kHorizontal, .length_km = 10};
  EXPECT_NEAR(rain_loss(path, 1).exceeded_db, 1.3009, 5e-5);
  EXPECT_NEAR(rain_loss(path, 10).exceeded_db, 8.1584, 5e-5);
}

TEST(RainLoss, OutageIsWhereTheMarginIsExceeded) {
  for (const RainCase& e : kRain) {
    const RainLoss rain = rain_of(e);
    for (const double percent : {0.0011, 0.004, 0.01, 0.2, 0.99}) {
      const auto outage = rain_outage(rain, e.ghz, rain_exceeded_db(rain, e.ghz, percent));
      ASSERT_TRUE(outage);
      EXPECT_NEAR(outage->percent, percent, 1e-9);
      EXPECT_FALSE(outage->at_most);
    }
    const auto rare = rain_outage(rain, e.ghz, e.of_0_001 + 1e-5);
    ASSERT_TRUE(rare);
    EXPECT_EQ(rare->percent, 0.001);
    EXPECT_TRUE(rare->at_most);
    EXPECT_FALSE(rain_outage(rain, e.ghz, e.of_1 - 1e-5));
  }
}

/// What the implementation of P.2001 that SG3 validated gives for its attachment B.3, which is P.530-17's planning
/// method.
TEST(MultipathFading, AgreesWithAttachmentB3OfP2001) {
  const struct {
    MultipathPath path;
    double factor, latitude_deg, percent;
  } cases[] = {{{7.5, 34, 2.9, 210}, geoclimatic_factor(-300), 51.5, 0.7955818801987861},
               {{6.2, 50, 1, 50}, geoclimatic_factor(-400), 20, 29.1962052590153},
               {{18, 12, 25, 800}, geoclimatic_factor(-150), -33, 0.0005463009867814622},
               {{4, 90, 0.5, 10}, 1e-4, 67, 30.073862912172334}};
  for (const auto& e : cases) {
    const double year = multipath_occurrence(e.path, e.factor) * year_of_month(e.path, e.latitude_deg);
    EXPECT_NEAR(year / e.percent, 1, 1e-12) << e.path.length_km;
  }
}

/// What ITU-Rpy's implementation of P.530-17 section 2.3.2 gives.
TEST(MultipathFading, ShallowFadesAgreeWithAnotherImplementation) {
  EXPECT_NEAR(multipath_exceeded(35, 10), 1.7714213530122924, 1e-9);
  EXPECT_NEAR(multipath_exceeded(35, 20), 0.2869766055436429, 1e-9);
  EXPECT_NEAR(multipath_exceeded(35, 25.5), 0.0956846705515324, 1e-9);
  EXPECT_NEAR(multipath_exceeded(35, 38), 0.0055471261736139, 1e-9);
  EXPECT_NEAR(multipath_exceeded(0.8, 5), 0.9740193342750447, 1e-9);
  EXPECT_NEAR(multipath_exceeded(0.8, 15), 0.025338919879691613, 1e-9);
}

/// P.530-17 section 2.3.4, steps 1 and 2, by hand.
TEST(MultipathFading, TheYearIsBetterThanTheWorstMonthByABoundedAmount) {
  EXPECT_NEAR(year_of_month({18, 5.1, 200, 10}, 50), std::pow(10, -1.08), 1e-12) << "10.8 dB at most";
  const MultipathPath path{7.5, 34, 2.9, 210};
  const double turn = std::pow(std::cos(89.6 * std::acos(-1.0) / 180), 0.7);
  EXPECT_NEAR(year_of_month(path, 44.8) / year_of_month(path, 45.2), std::pow((1.1 + turn) / (1.1 - turn), 0.56), 1e-9)
      << "the sign changes at 45 degrees";
}

TEST(MultipathFading, DeepAndShallowFadesMeet) {
  for (const double p0 : {1e-6, 0.02, 3.0, 80.0})
    for (const double part : {1.0, 0.1}) {
      const double deep = 25 + 1.2 * std::log10(p0);
      EXPECT_NEAR(multipath_exceeded(p0, deep - 1e-9, part) / multipath_exceeded(p0, deep, part), 1, 1e-6) << p0;
      EXPECT_NEAR(multipath_exceeded(p0, 40, part), part * p0 / 1e4, 1e-12);
    }
}

/// A path in sight whose losses are given.
PathLosses in_sight(double free_space_db, double diffraction_db = 0) {
  PathLosses losses;
  losses.free_space_db = free_space_db, losses.ld_db = diffraction_db;
  return losses;
}

constexpr RadioPath k18{.frequency_ghz = 18, .polarisation = Polarisation::kVertical};
constexpr BudgetCourse kNineKm{9000, {320, 290}, 40.0, 51.5};
/// 18 dBm, 38 dBi, 1 dB; 38 dBi, 1.5 dB; -72 dBm.
BudgetQuery radios() {
  return {.power_dbm = 18,
          .from_gain_dbi = 38,
          .to_gain_dbi = 38,
          .from_feeder_db = 1,
          .to_feeder_db = 1.5,
          .sensitivity_dbm = -72};
}

TEST(LinkBudget, AddsUp) {
  const PathLosses losses = in_sight(136.635, 2);
  const LinkBudget budget = link_budget(losses, k18, kNineKm, radios());
  EXPECT_DOUBLE_EQ(budget.eirp_dbm, 55);
  ASSERT_TRUE(budget.gases_db);
  EXPECT_NEAR(*budget.gases_db, 9 * gas_loss(18).both_db_km(), 1e-12);
  EXPECT_NEAR(budget.level_dbm, 18 + 38 - 1 - 136.635 - 2 - *budget.gases_db + 38 - 1.5, 1e-9);
  EXPECT_NEAR(*budget.margin_db, budget.level_dbm + 72, 1e-12);
  EXPECT_FALSE(budget.rain);
  EXPECT_FALSE(budget.multipath);
  EXPECT_EQ(budget.left_out, (std::vector<std::string>{
                                 "rain (no rate is given)",
                                 "multipath (neither a geoclimatic factor nor a gradient of refractivity is given)",
                                 "availability (neither rain nor multipath is counted)"}));
}

TEST(LinkBudget, AnEirpTakesThePlaceOfTheFirstEnd) {
  const BudgetQuery query{.eirp_dbm = 55, .to_gain_dbi = 38, .to_feeder_db = 1.5, .sensitivity_dbm = -72};
  const LinkBudget by_eirp = link_budget(in_sight(136.6), k18, kNineKm, query);
  EXPECT_DOUBLE_EQ(by_eirp.level_dbm, link_budget(in_sight(136.6), k18, kNineKm, radios()).level_dbm);
}

TEST(LinkBudget, AddsTheOutagesOfRainAndMultipath) {
  BudgetQuery query = radios();
  query.rain_rate_mm_h = 28, query.refractivity_gradient = -300;
  const LinkBudget budget = link_budget(in_sight(136.635), k18, kNineKm, query);
  ASSERT_TRUE(budget.availability);
  EXPECT_TRUE(budget.left_out.empty());
  const double inclination = 30.0 / 9;
  const MultipathPath path{18, 9, inclination, 290};
  const double p0 = multipath_occurrence(path, std::pow(10, -4.6 + 0.81));
  EXPECT_NEAR(budget.multipath->occurrence_percent, p0, 1e-12);
  EXPECT_NEAR(*budget.multipath->worst_month_percent, multipath_exceeded(p0, *budget.margin_db), 1e-12);
  const double multipath = multipath_exceeded(p0, *budget.margin_db, year_of_month(path, 51.5));
  EXPECT_NEAR(budget.multipath_outage->percent, multipath, 1e-12);
  const double out = budget.rain_outage->percent + multipath;
  EXPECT_NEAR(budget.availability->percent, 100 - out, 1e-12);
  EXPECT_NEAR(budget.availability->outage_minutes, out / 100 * 525960, 1e-9);
}

TEST(LinkBudget, WithoutALatitudeTheYearIsAsBadAsTheWorstMonth) {
  BudgetQuery query = radios();
  query.geoclimatic_factor = 1e-4;
  const LinkBudget budget = link_budget(in_sight(136.635), k18, {9000, {320, 290}}, query);
  EXPECT_DOUBLE_EQ(budget.multipath_outage->percent, *budget.multipath->worst_month_percent);
  EXPECT_TRUE(budget.multipath_outage->at_most);
  EXPECT_TRUE(budget.availability->at_least);
}

TEST(LinkBudget, ShortPathsDoNotFade) {
  BudgetQuery query = radios();
  query.geoclimatic_factor = 1e-4;
  const LinkBudget budget = link_budget(in_sight(130), k18, {5000, {320, 290}}, query);
  EXPECT_EQ(budget.multipath->occurrence_percent, 0);
  EXPECT_EQ(budget.multipath_outage->percent, 0);
  EXPECT_EQ(budget.availability->percent, 100);
  EXPECT_FALSE(budget.availability->at_least);
}

std::string left_out_of(const PathLosses& losses, double ghz, const BudgetCourse& course, const BudgetQuery& query) {
  std::string all;
  RadioPath path = k18;
  path.frequency_ghz = ghz;
  for (const std::string& what : link_budget(losses, path, course, query).left_out) all += what + "; ";
  return all;
}

TEST(LinkBudget, NamesTheRangesThatItIsOutside) {
  BudgetQuery query = radios();
  query.rain_rate_mm_h = 28, query.geoclimatic_factor = 1e-4;
  const BudgetCourse seventy{70000, {900, 800}, 40.0, 51.5};
  EXPECT_EQ(left_out_of(in_sight(120), 0.45, kNineKm, query),
            "gases (0.45 GHz is outside of 1 to 1000 GHz, the range of P.676); "
            "rain (0.45 GHz is outside of 1 to 100 GHz, the range of P.530); "
            "multipath (0.45 GHz is outside of 1.7 to 45 GHz, the range of P.530 for 9.0 km); "
            "availability (neither rain nor multipath is counted); ");
  EXPECT_EQ(left_out_of(in_sight(120), 80, kNineKm, query),
            "multipath (80 GHz is outside of 1.7 to 45 GHz, the range of P.530 for 9.0 km); ");
  EXPECT_EQ(left_out_of(in_sight(162), 18, kNineKm, query),
            "availability (for more than 1 % of the year rain takes more than the margin, and P.530 tells no more); ");
  EXPECT_EQ(left_out_of(in_sight(120), 7, seventy, query), "rain (70.0 km is beyond 60 km, the range of P.530); ");
  PathLosses hidden = in_sight(120);
  hidden.horizons.trans_horizon = true;
  EXPECT_EQ(left_out_of(hidden, 18, kNineKm, query),
            "multipath (the path is trans-horizon, and P.530 is for paths in sight); ");
  EXPECT_EQ(left_out_of(in_sight(220), 18, kNineKm, query),
            "availability (the level in clear air is not above the sensitivity); ");
  query.sensitivity_dbm.reset();
  EXPECT_EQ(left_out_of(in_sight(120), 18, kNineKm, query), "availability (no sensitivity is given); ");
}

void expect_refused(const BudgetQuery& query, const std::string& field) {
  try {
    query.validate();
    ADD_FAILURE() << field << " was taken";
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), field) << error.what();
  }
}

TEST(LinkBudget, RefusesWhatContradictsItself) {
  radios().validate();
  BudgetQuery().validate();
  expect_refused({.power_dbm = 20, .eirp_dbm = 40}, "eirp_dbm");
  expect_refused({.sensitivity_dbm = -70}, "sensitivity_dbm");
  expect_refused({.rain_rate_mm_h = 30}, "rain_rate_mm_h");
  expect_refused({.eirp_dbm = 40, .from_gain_dbi = 30}, "gain_dbi");
  expect_refused({.eirp_dbm = 40, .from_feeder_db = 1}, "feeder_loss_db");
  expect_refused({.power_dbm = 20, .to_feeder_db = -1}, "feeder_loss_db");
  expect_refused({.power_dbm = 20, .sensitivity_dbm = 70}, "sensitivity_dbm");
  expect_refused({.power_dbm = 20, .rain_rate_mm_h = 0}, "rain_rate_mm_h");
  expect_refused({.power_dbm = 20, .geoclimatic_factor = -1}, "geoclimatic_factor");
  expect_refused({.power_dbm = 20, .refractivity_gradient = 300}, "refractivity_gradient");
  expect_refused({.power_dbm = 20, .geoclimatic_factor = 1e-4, .refractivity_gradient = -300}, "refractivity_gradient");
  expect_refused({.power_dbm = std::nan("")}, "power_dbm");
}

}  // namespace

}  // namespace itin::profile
