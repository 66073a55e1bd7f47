// Fresnel clearance, required heights and verdicts against dense sampling and values worked by hand.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <profile/fresnel.hpp>
#include <profile/los.hpp>
#include <profile/radio_text.hpp>
#include <profile/report_text.hpp>
#include <profile/required_heights.hpp>

#include "published_profile.hpp"

namespace itin::profile {

namespace {

using test::even_profile;

constexpr int kSamplesPerPiece = 400;

/// Height of the ground and of the ray over it by interpolation, at `kSamplesPerPiece` places of every piece and at
/// others that close in on its ends, where a zone is narrow.
template <class Visit>
void sample(const Profile& profile, const Antennas& antennas, const Earth& earth, Visit visit) {
  for (std::size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    const auto visit_at = [&](double s) {
      const double d = a.distance_m + (b.distance_m - a.distance_m) * s, t = d / profile.length_m;
      const double ground = a.ground_m + (b.ground_m - a.ground_m) * s;
      const double ray = antennas.from_m * (1 - t) + antennas.to_m * t;
      visit(d, ray - ground - earth.drop_coefficient() * d * (profile.length_m - d));
    };
    for (int k = 0; k <= kSamplesPerPiece; ++k) visit_at(static_cast<double>(k) / kSamplesPerPiece);
    for (double s = 0.5; s > 1e-9; s *= 0.8) visit_at(s), visit_at(1 - s);
  }
}

/// Either hills, or every fifth time a plain of long pieces, few or many: there the least clearance is within a piece.
Profile random_profile(std::mt19937& random, int round) {
  const bool plain = round % 5 == 4;
  std::uniform_real_distribution<double> step(plain ? 5000 : 20, plain ? 40000 : 1500), height(0, plain ? 0.2 : 120);
  const int points = !plain ? 12 : round % 2 == 0 ? 4 : 32;
  Profile profile;
  double d = 0;
  for (int i = 0; i < points; ++i, d += step(random)) {
    ProfilePoint p;
    p.distance_m = d, p.ground_m = height(random);
    profile.points.push_back(p);
  }
  profile.length_m = profile.points.back().distance_m;
  return profile;
}

Antennas antennas(const Profile& profile, double from, double to) {
  return {profile.points.front().ground_m + from, profile.points.back().ground_m + to};
}

TEST(FresnelRadius, UsesTheExactSpeedOfLight) {
  // 17.314 sqrt(d1 d2 / (f d)) in km and GHz; 20.7 m would be the second zone at 7 GHz of a 20 km path (Bacon 2002).
  EXPECT_NEAR(fresnel_radius_m(1000, 1000, wavelength_m(1)), 17.3145 * std::sqrt(0.5), 1e-3);
  EXPECT_NEAR(std::sqrt(2.0) * fresnel_radius_m(10000, 10000, wavelength_m(7)), 20.7, 0.05);
  EXPECT_NEAR(std::sqrt(2.0) * fresnel_radius_m(10000, 10000, wavelength_m(2)), 38.7, 0.05);
}

TEST(FresnelClearance, AgreesWithDenseSampling) {
  std::mt19937 random(4101);
  const Earth earth = Earth::effective_earth(4.0 / 3);
  for (int round = 0; round < 200; ++round) {
    const Profile profile = random_profile(random, round);
    const Antennas ends = antennas(profile, 5 + round % 60, 100);
    const double wavelength = wavelength_m(round % 2 ? 7.5 : 0.4);
    const auto least = fresnel_clearance(profile, ends, earth, wavelength);
    double sampled = std::numeric_limits<double>::infinity();
    sample(profile, ends, earth, [&](double d, double clearance) {
      const double radius = fresnel_radius_m(d, profile.length_m - d, wavelength);
      if (radius > 0) sampled = std::min(sampled, clearance / radius);
    });
    ASSERT_TRUE(least);
    EXPECT_LE(least->fraction, sampled + 1e-9) << round;
    EXPECT_NEAR(least->fraction, sampled, 0.02 * std::max(1.0, std::abs(sampled))) << round;
  }
}

TEST(FresnelClearance, HasNoneWithoutLength) {
  EXPECT_FALSE(fresnel_clearance(even_profile(0, {1}), {2, 2}, Earth(), 0.1));
}

TEST(RequiredHeights, AreJustEnough) {
  std::mt19937 random(4102);
  for (int round = 0; round < 120; ++round) {
    const Profile profile = random_profile(random, round);
    const Requirement requirement{Earth::effective_earth(round % 2 ? 4.0 / 3 : 2.0 / 3), round % 3 * 0.3,
                                  wavelength_m(6)};
    const PlannedHeights planned{20, 15};
    const RequiredHeights heights = required_heights(profile, planned, requirement);
    const auto shortfall = [&](double from, double to) {
      double worst = -std::numeric_limits<double>::infinity();
      sample(profile, antennas(profile, from, to), requirement.earth, [&](double d, double clearance) {
        const double radius = fresnel_radius_m(d, profile.length_m - d, requirement.wavelength);
        worst = std::max(worst, requirement.fraction * radius - clearance);
      });
      return worst;
    };
    const auto expect_just = [&](double from, double to, double height) {
      EXPECT_LE(shortfall(from, to), 1e-6) << round;
      if (height <= 0.01) return;
      // 2 cm less is too little; near an end that is a hair, which sampling may step over.
      EXPECT_GT(shortfall(from - (from == height ? 0.02 : 0), to - (to == height ? 0.02 : 0)), -1e-4);
    };
    ASSERT_TRUE(heights.from_alone_m && heights.to_alone_m && heights.both_equal_m);
    expect_just(*heights.from_alone_m, planned.to_m, *heights.from_alone_m);
    expect_just(planned.from_m, *heights.to_alone_m, *heights.to_alone_m);
    expect_just(*heights.both_equal_m, *heights.both_equal_m, *heights.both_equal_m);
    const std::vector<HeightPair> curve = height_curve(profile, planned, requirement, heights.both_equal_m);
    ASSERT_EQ(curve.size(), static_cast<std::size_t>(kCurvePoints));
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const HeightPair& pair = curve[i];
      if (!pair.to_m) continue;
      EXPECT_LE(shortfall(pair.from_m, *pair.to_m), 1e-6);
      if (i > 0 && curve[i - 1].to_m) {
        EXPECT_LE(*pair.to_m, *curve[i - 1].to_m + 1e-9);
      }
    }
  }
}

TEST(RequiredHeights, WorkedByHand) {
  // A ridge of 30 m at 2 of 5 km on a flat Earth; the far end stands at 10 m: 30 = h 3/5 + 10 2/5.
  const Profile profile = even_profile(1000, {0, 0, 30, 0, 0, 0});
  const RequiredHeights heights = required_heights(profile, {10, 10}, {Earth::flat(), 0, 0});
  EXPECT_NEAR(*heights.from_alone_m, 26 / 0.6, 1e-9);
  EXPECT_NEAR(*heights.to_alone_m, 24 / 0.4, 1e-9);
  EXPECT_NEAR(*heights.both_equal_m, 30, 1e-9);
}

TEST(RequiredHeights, AreNoneWhereNoHeightHelps) {
  // An antenna on the ground has no Fresnel clearance near itself, whatever stands at the other end.
  const Profile profile = even_profile(1000, {0, 0, 0});
  const RequiredHeights heights = required_heights(profile, {10, 0}, {Earth::flat(), 0.6, wavelength_m(1)});
  EXPECT_FALSE(heights.from_alone_m);
  EXPECT_TRUE(heights.to_alone_m);
  EXPECT_TRUE(heights.both_equal_m);
  // Sight alone needs no height over a flat Earth, and the limit at the bare end is that of the ground's slope.
  EXPECT_NEAR(*required_heights(profile, {0, 0}, {Earth::flat(), 0, 0}).from_alone_m, 0, 1e-9);
  EXPECT_NEAR(*required_heights(even_profile(1000, {0, 0, -50}), {0, 0}, {Earth::flat(), 0, 0}).from_alone_m, 50, 1e-9);
}

TEST(VisibleHeight, OfATurbineBehindARidge) {
  // From 2 m the line over the ridge (30 m at 2 km) rises 14 m per km: 72 m at 5 km.
  const Profile profile = even_profile(1000, {0, 0, 30, 0, 0, 0});
  const VisibleHeight seen = visible_height(profile, 2, {80, 125}, Earth::flat());
  EXPECT_NEAR(seen.from_m, 72, 1e-9);
  ASSERT_TRUE(seen.hub);
  EXPECT_NEAR(seen.hub->visible_m, 8, 1e-9);
  EXPECT_NEAR(seen.hub->fraction, 0.1, 1e-9);
  EXPECT_NEAR(seen.tip.visible_m, 53, 1e-9);
  EXPECT_NEAR(seen.tip.fraction, 53.0 / 125, 1e-9);
  const VisibleHeight hidden = visible_height(profile, 2, {{}, 60}, Earth::flat());
  EXPECT_FALSE(hidden.hub);
  EXPECT_EQ(hidden.tip.visible_m, 0);
  EXPECT_EQ(hidden.from_m, 60);
}

LosQuery query(double from, double to, const Earth& earth) {
  LosQuery q;
  q.from_height_m = from, q.to_height_m = to, q.earth = earth;
  return q;
}

TEST(Analyse, FindsObstructionsAsIntervals) {
  const Profile profile = even_profile(1000, {0, 40, 0, 0, 60, 0});
  const LosReport report = analyse(profile, query(20, 20, Earth::flat()));
  EXPECT_EQ(report.verdict, SightVerdict::kHidden);
  ASSERT_EQ(report.obstructions.size(), 2U);
  EXPECT_NEAR(report.obstructions[0].from_m, 500, 1e-6);
  EXPECT_NEAR(report.obstructions[0].to_m, 1500, 1e-6);
  EXPECT_NEAR(report.obstructions[0].depth_m, 20, 1e-9);
  EXPECT_NEAR(report.obstructions[1].from_m, 3000 + 1000.0 / 3, 1e-6);
  EXPECT_NEAR(report.obstructions[1].peak_at_m, 4000, 1e-9);
  EXPECT_NEAR(report.obstructions[1].peak_m, 60, 1e-9);
  EXPECT_NEAR(*report.clearance_m, -40, 1e-9);
  EXPECT_NEAR(report.critical->distance_m, 4000, 1e-9);
}

TEST(Analyse, AgreesWithDenseSamplingAndWithItsMirrorImage) {
  std::mt19937 random(4103);
  const Earth earth;
  for (int round = 0; round < 200; ++round) {
    const Profile profile = random_profile(random, round);
    const double from = 1 + round % 50, to = 2 + round % 90;
    const LosReport report = analyse(profile, query(from, to, earth));
    double sampled = std::numeric_limits<double>::infinity(), cut = 0;
    sample(profile, report.antennas, earth, [&](double, double clearance) { sampled = std::min(sampled, clearance); });
    for (const Obstruction& o : report.obstructions) cut = std::max(cut, o.depth_m);
    EXPECT_EQ(report.verdict == SightVerdict::kHidden, cut > 0);
    EXPECT_NEAR(cut, std::max(0.0, -*report.clearance_m), 1e-9);
    if (cut > 0) {
      EXPECT_LE(*report.clearance_m, sampled + 1e-9);
      EXPECT_NEAR(*report.clearance_m, sampled, 0.05);
    } else {
      const auto zone = fresnel_clearance(profile, report.antennas, earth, 0.1);
      EXPECT_NEAR(*report.clearance_m, zone->clearance_m, 1e-6);
      EXPECT_GE(*report.clearance_m, sampled - 0.05);
    }
    const LosReport back = analyse(reversed(profile), query(to, from, earth));
    EXPECT_EQ(report.verdict, back.verdict);
    EXPECT_EQ(report.obstructions.size(), back.obstructions.size());
    EXPECT_NEAR(*report.clearance_m, *back.clearance_m, 1e-9);
  }
}

TEST(Analyse, TellsTheGreatestLackOfMetresAlongTheLine) {
  std::mt19937 random(4104);
  const Earth earth = Earth::effective_earth(4.0 / 3);
  int lacking = 0;
  for (int round = 0; round < 200; ++round) {
    const Profile profile = random_profile(random, round);
    LosQuery q = query(1 + round % 50, 2 + round % 90, earth);
    q.radio = RadioPath{.frequency_ghz = 6, .effective_earth_km = 6371 * 4.0 / 3};
    q.criteria = {{4.0 / 3, round % 2 == 0 ? 0.6 : 2.5}};
    const LosReport report = analyse(profile, q);
    const CriterionResult& c = report.criteria.front();
    if (!c.margin_f1 || *c.margin_f1 >= 0) continue;
    ++lacking;
    const auto left = [&](double at, double clearance) {
      return clearance - c.criterion.fraction * fresnel_radius_m(at, profile.length_m - at, wavelength_m(6));
    };
    double sampled = std::numeric_limits<double>::infinity(), at_place = sampled, nearest = sampled;
    sample(profile, report.antennas, earth, [&](double at, double clearance) {
      sampled = std::min(sampled, left(at, clearance));
      if (const double away = std::abs(at - *c.margin_at_m); away < nearest)
        nearest = away, at_place = left(at, clearance);
    });
    EXPECT_LE(*c.margin_m, sampled + 1e-9);
    EXPECT_NEAR(*c.margin_m, sampled, 0.05);
    EXPECT_NEAR(*c.margin_m, at_place, 0.1);
  }
  EXPECT_GT(lacking, 50);
}

TEST(Analyse, JudgesCriteriaOnTheirOwnEarth) {
  // 20 km over flat ground: the bulge is 11.8 m at K = 1/2 x 4/3 ... worked from d^2 / (2 K R) at the middle.
  const Profile profile = even_profile(10000, {0, 0, 0});
  LosQuery q = query(15, 15, Earth::effective_earth(4.0 / 3));
  q.radio = RadioPath{.frequency_ghz = 20, .effective_earth_km = 6371 * 4.0 / 3};
  q.criteria = {{4.0 / 3, 0.6}, {4.0 / 3, 1.0}, {0.5, 0.0}};
  const LosReport report = analyse(profile, q);
  ASSERT_EQ(report.criteria.size(), 3U);
  const double clearance = 15 - 1e8 / (2 * 4.0 / 3 * 6371000), f1 = fresnel_radius_m(1e4, 1e4, wavelength_m(20));
  EXPECT_NEAR(*report.criteria[0].clearance_f1, clearance / f1, 1e-6);
  for (const CriterionResult& c : {report.criteria[0], report.criteria[1]}) {
    EXPECT_EQ(c.verdict, clearance / f1 >= c.criterion.fraction ? CriterionVerdict::kMeets : CriterionVerdict::kFails);
    EXPECT_NEAR(*c.margin_m, clearance - c.criterion.fraction * f1, 1e-6);
    EXPECT_NEAR(*c.margin_f1, clearance / f1 - c.criterion.fraction, 1e-6);
  }
  EXPECT_NEAR(*report.criteria[2].clearance_m, 15 - 1e8 / (2 * 0.5 * 6371000), 1e-6);
  EXPECT_EQ(report.criteria[2].verdict, CriterionVerdict::kFails);
}

TEST(Judge, FindsWhatAnalyseFinds) {
  std::mt19937 random(4104);
  for (int round = 0; round < 200; ++round) {
    const Profile profile = random_profile(random, round), ground = even_profile(profile.length_m, {-5, -5});
    LosQuery q = query(1 + round % 50, 2 + round % 90, Earth{});
    q.criteria = {{0.8, 0}};
    q.from_on_surface = round % 2 == 0;
    if (round % 3 == 0) q.radio = RadioPath{.frequency_ghz = 6, .effective_earth_km = 8494.7};
    const LosReport report = analyse(profile, q, ground);
    const LineFindings found = judge(profile, q, ground);
    EXPECT_EQ(found.verdict, report.verdict);
    EXPECT_EQ(found.known_verdict, report.known_verdict);
    EXPECT_EQ(found.clearance_m, report.clearance_m);
    EXPECT_EQ(found.least_clearance_m, report.least_clearance_m);
    ASSERT_EQ(found.fresnel.has_value(), round % 3 == 0 && report.fresnel.has_value());
    if (found.fresnel) {
      EXPECT_EQ(found.fresnel->fraction, report.fresnel->fraction);
    }
    EXPECT_EQ(found.criteria.front().verdict, report.criteria.front().verdict);
  }
  LosQuery beneath = query(-1, 2, Earth{});
  EXPECT_THROW(judge(random_profile(random, 0), beneath), InputError);
}

TEST(Analyse, JudgesTheWorstFadeByTheLineItself) {
  EXPECT_NEAR(fade_factor(20000), 0.5658, 1e-4);   // 157 / (144 + 133.5)
  EXPECT_NEAR(fade_factor(100000), 0.9198, 1e-4);  // 157 / (144 + 26.7)
  for (const double shorter : {10000.0, 660.0, 1.0}) EXPECT_NEAR(fade_factor(shorter), 157.0 / 411, 1e-9);
  const Profile profile = even_profile(10000, {0, 20, 0});
  LosQuery q = query(60, 60, Earth::effective_earth(4.0 / 3));
  q.radio = RadioPath{.frequency_ghz = 6, .effective_earth_km = 8494.7};
  q.criteria = {{.k = 157 / 277.5, .fraction = 0.3}, {.fraction = 0.3, .fade = true}};
  const LosReport report = analyse(profile, q);
  ASSERT_EQ(report.criteria.size(), 2U);
  EXPECT_EQ(report.criteria[1].k, report.criteria[0].k);
  EXPECT_EQ(report.criteria[1].clearance_m, report.criteria[0].clearance_m);
  EXPECT_EQ(report.required[3].name, "K = 0.5658 (ke), 0.3 F1");
  EXPECT_EQ(report.required[3].heights.both_equal_m, report.required[2].heights.both_equal_m);
  EXPECT_EQ(parse_criterion("ke:0.3"), q.criteria[1]);
  EXPECT_THROW(parse_criterion("kx:0.3"), InputError);
}

TEST(Analyse, LeavesOpenWhatTheCertificateCannotDecide) {
  LosQuery q = query(20, 20, Earth::flat());
  const Profile profile = even_profile(1000, {0, 15, 0});
  q.clearance_error_m = 4;
  EXPECT_EQ(analyse(profile, q).verdict, SightVerdict::kVisible);
  q.clearance_error_m = 6;
  EXPECT_EQ(analyse(profile, q).verdict, SightVerdict::kUndecided);
}

/// Level ground at 0 m but for a rise of 12 m, with nothing known from 3 to 4 km.
Profile with_a_gap() {
  Profile profile = even_profile(1000, {0, 12, 0, 0, 0, 0});
  profile.gaps = {{3000, 4000}};
  return profile;
}

TEST(Analyse, LeavesOpenWhatLiesBeyondKnownGround) {
  LosQuery q = query(20, 20, Earth::flat());
  q.criteria = {{4.0 / 3, 0}};
  const LosReport open = analyse(with_a_gap(), q);
  EXPECT_EQ(open.verdict, SightVerdict::kUndecided);
  EXPECT_EQ(open.known_verdict, SightVerdict::kVisible);
  EXPECT_EQ(open.criteria[0].verdict, CriterionVerdict::kUndecided);
  EXPECT_EQ(gap_text(open, unit_of(open)),
            "no data over 1.000 km of the line, which leaves it undecided; known ground does not hide it");
  EXPECT_EQ(outcome_text(open.criteria[0], unit_of(open)).substr(0, 17), "undecided; met by");
  q.nodata = NoData::kBlock;
  EXPECT_EQ(analyse(with_a_gap(), q).verdict, SightVerdict::kHidden);
  EXPECT_EQ(outcome_text(analyse(with_a_gap(), q).criteria[0], DistanceUnit::kMetres),
            "fails: ground without data counts as blocking");
  q.nodata = NoData::kClear;
  EXPECT_EQ(analyse(with_a_gap(), q).verdict, SightVerdict::kVisible);
  EXPECT_EQ(analyse(with_a_gap(), q).criteria[0].verdict, CriterionVerdict::kMeets);
  q.nodata = NoData::kUnknown, q.from_height_m = q.to_height_m = 5;
  const LosReport hidden = analyse(with_a_gap(), q);
  EXPECT_EQ(hidden.verdict, SightVerdict::kHidden);
  EXPECT_EQ(hidden.criteria[0].verdict, CriterionVerdict::kFails);
  EXPECT_EQ(verdict_text(hidden), "Hidden: no data over 1.000 km of the line; known ground hides it");
}

TEST(Analyse, NamesNoFootAsTheCriticalPoint) {
  // The eye's foot is 2 m below the ray, the rise at 2 km 3 m: it is the rise that a planner looks at.
  const Profile profile = even_profile(1000, {0, 0, 9, 0, 0});
  const LosReport report = analyse(profile, query(2, 22, Earth::flat()));
  EXPECT_NEAR(report.critical->distance_m, 2000, 1e-6);
  EXPECT_NEAR(*report.clearance_m, 3, 1e-6);
  LosQuery radio = query(2, 22, Earth::flat());
  radio.radio = RadioPath{.frequency_ghz = 6};
  const LosReport with_frequency = analyse(profile, radio);
  EXPECT_NEAR(with_frequency.critical->distance_m, report.critical->distance_m, 1e-6);
  EXPECT_NEAR(*with_frequency.clearance_m, *report.clearance_m, 1e-6);
}

/// Whether the sum of ground and height falls short of a wall's top by a rounding is nobody's concern.
TEST(Analyse, GivesLossesToAntennasLevelWithWhatTheyStandIn) {
  for (int i = 0; i < 200; ++i) {
    const double ground = -1.7430211560805577 + 0.01 * i, top = ground + 1.5;
    const Profile surface = even_profile(1000, {top, 0, 0, top}), bare = even_profile(1000, {ground, 0, 0, ground});
    LosQuery q = query(1.5, 1.5 - 1e-9, Earth::effective_earth(4.0 / 3));
    q.radio = RadioPath{.frequency_ghz = 0.9, .effective_earth_km = 6371 * 4.0 / 3};
    ASSERT_TRUE(analyse(surface, q, bare).losses) << i;
    q.to_height_m = 1.499;
    ASSERT_FALSE(analyse(surface, q, bare).losses) << i;
  }
}

TEST(Analyse, JudgesClutterWhereTheLossesHaveIt) {
  Profile profile = even_profile(1000, {0, 0, 0, 0, 0});
  for (ProfilePoint& p : profile.points) p.clutter_m = 25;
  LosQuery q = query(20, 20, Earth::effective_earth(4.0 / 3));
  q.radio = RadioPath{.frequency_ghz = 6, .effective_earth_km = 6371 * 4.0 / 3};
  const LosReport report = analyse(profile, q);
  EXPECT_EQ(report.verdict, SightVerdict::kHidden);
  EXPECT_EQ(cause_of(report, report.critical->theme), "clutter");
  EXPECT_GT(*report.required[0].heights.both_equal_m, 25);
  EXPECT_EQ(report.stands_on.from_m, 0);
  ASSERT_TRUE(report.bare);
  EXPECT_EQ(report.bare->verdict, SightVerdict::kVisible);
  EXPECT_LT(*report.bare->required[0].heights.both_equal_m, 5);
  EXPECT_EQ(report.losses->ld_db, path_losses(with_spacing(profile, 80), report.antennas, *q.radio).ld_db);
}

TEST(RequiredText, NeverRoundsBelowWhatIsRequired) {
  EXPECT_EQ(required_text(14.661), "14.67 m");
  EXPECT_EQ(required_text(14.66), "14.66 m");
  EXPECT_EQ(required_text(0), "0.00 m");
  EXPECT_EQ(required_text(std::nullopt), "no height is enough");
}

TEST(Analyse, TakesALineWithoutLength) {
  Profile point = even_profile(0, {100});
  const LosReport report = analyse(point, query(2, 5, Earth()));
  EXPECT_EQ(report.verdict, SightVerdict::kVisible);
  EXPECT_EQ(*report.clearance_m, 2);
}

TEST(Analyse, RefusesWhatHasNoMeaning) {
  const Profile profile = even_profile(1000, {0, 0});
  EXPECT_THROW(analyse(profile, query(-1, 0, Earth())), InputError);
  LosQuery q = query(1, 1, Earth());
  q.criteria = {{4.0 / 3, 0.6}};
  EXPECT_THROW(analyse(profile, q), InputError);
}

}  // namespace

}  // namespace itin::profile
