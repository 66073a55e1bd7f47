// Patterns of antennas: files of both formats, and losses off the axis.
#include <cmath>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>

#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <profile/antenna_loss.hpp>
#include <profile/diffraction.hpp>

#include "support/temporary_directory.hpp"

namespace itin::profile {

namespace {

class AntennaPatterns : public testing::Test {
 protected:
  AntennaPattern read(const std::string& text) const {
    return read_antenna_pattern(directory_.write("antenna.msi", text));
  }
  std::string error_of(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      const std::string what = error.what();
      return what.substr(what.find(", ") + 2);
    }
    return "none";
  }

 private:
  const test::TemporaryDirectory directory_;
};

std::string numbers(int count, double (*of)(int)) {
  std::ostringstream text;
  for (int i = 0; i < count; ++i) text << of(i) << '\n';
  return text.str();
}

constexpr const char* kSmall =
    "NAME Sector 65\r\nFREQUENCY 5800\r\nGAIN 15 dBi\r\nHORIZONTAL 4\r\n0 0,5\r\n90 10\r\n180 25\r\n270 12\r\n"
    "Vertical 4\n0 0.5\n90\t20\n180 30\n270 22\n";

TEST_F(AntennaPatterns, ReadMsi) {
  const AntennaPattern pattern = read(kSmall);
  EXPECT_EQ(pattern.gain_dbi, 15);
  EXPECT_EQ(pattern.frequency_mhz, 5800);
  EXPECT_EQ(pattern.horizontal, (AntennaPattern::Cut{{0, 0.5}, {90, 10}, {180, 25}, {270, 12}}));
  EXPECT_EQ(pattern.vertical, (AntennaPattern::Cut{{0, 0.5}, {90, 20}, {180, 30}, {270, 22}}));
  EXPECT_DOUBLE_EQ(*read(std::string("GAIN 15\n") + (kSmall + std::string(kSmall).find("HORIZONTAL"))).gain_dbi, 17.15);
}

TEST_F(AntennaPatterns, RefuseOtherFiles) {
  EXPECT_EQ(error_of(""), "line 0: the file is empty");
  EXPECT_EQ(error_of("NAME a\nHORIZONTAL 2\n0 0\n90 1\n"), "line 4: the pattern has no VERTICAL cut");
  EXPECT_EQ(error_of("x\n"),
            "line 1: the file is no antenna pattern: MSI has HORIZONTAL and VERTICAL, .ant has numbers");
  EXPECT_EQ(error_of("HORIZONTAL 3\n0 0\n90 1\nVERTICAL 1\n"), "line 4: 'VERTICAL' comes after 2 of 3 angles");
  EXPECT_EQ(error_of("HORIZONTAL 3\n0 0\n90 1\n90 2\n"), "line 4: the cut has two losses at 90 degrees");
  EXPECT_EQ(error_of("HORIZONTAL 3\n0 15\n90 4\n180 -12\n"),
            "line 4: from -12 to 15 dB in one cut: give losses from the gain on the axis, not gains");
  EXPECT_EQ(error_of("HORIZONTAL 3\n0 0\n90 1\n"), "line 3: the file ends after 2 of 3 angles");
  EXPECT_EQ(error_of("HORIZONTAL 1\n0 x\n"), "line 2: 'x' is no number");
  EXPECT_EQ(error_of(numbers(360, [](int i) { return i / 10.0 - 15; })),
            "line 360: from -15 to 20.9 dB in one cut: give losses from the gain on the axis, not gains");
  EXPECT_EQ(error_of("HORIZONTAL\n"), "line 1: a number is missing");
  EXPECT_EQ(error_of("HORIZONTAL 1\n-20 1\n"), "line 2: -20 degrees is not within 0 to 360");
  EXPECT_EQ(error_of("GAIN 3 dB\n"), "line 1: 'dB' is neither dBd nor dBi");
  EXPECT_EQ(error_of("-1\n-2\n"), "line 2: 2 numbers; .ant has 360, 541 or 720");
  EXPECT_THROW(read_antenna_pattern("/no/such/file.msi"), FileError);
}

TEST_F(AntennaPatterns, MayHaveAMinus) {
  const AntennaPattern pattern = read("HORIZONTAL 3\n0 0.2\n90 -10\n180 -25\nVERTICAL 1\n0 0\n");
  EXPECT_EQ(pattern.horizontal, (AntennaPattern::Cut{{0, 0.2}, {90, 10}, {180, 25}}))
      << "a little more than on the axis";
  EXPECT_FALSE(pattern.frequency_mhz);
}

TEST_F(AntennaPatterns, ReadAnt) {
  const std::string horizontal = numbers(360, [](int i) { return -i / 10.0; });
  const AntennaPattern flat = read(horizontal);
  EXPECT_EQ(flat.horizontal[250], (std::pair<double, double>(250, 25)));
  EXPECT_EQ(flat.vertical[90].second, 0);
  // The vertical cut begins at the zenith and goes down by the front.
  const AntennaPattern full = read(horizontal + numbers(360, [](int i) { return -i / 100.0; }));
  EXPECT_DOUBLE_EQ(full.vertical[0].second, 0.9);    // the front
  EXPECT_DOUBLE_EQ(full.vertical[90].second, 1.8);   // the nadir
  EXPECT_DOUBLE_EQ(full.vertical[180].second, 2.7);  // behind
  EXPECT_DOUBLE_EQ(full.vertical[270].second, 0);    // the zenith
  const AntennaPattern front = read(horizontal + numbers(181, [](int i) { return -i / 100.0; }));
  EXPECT_DOUBLE_EQ(front.vertical[60].second, full.vertical[60].second);
  EXPECT_DOUBLE_EQ(front.vertical[120].second, full.vertical[60].second) << "what is behind is like what is before";
  EXPECT_FALSE(full.gain_dbi);
}

TEST_F(AntennaPatterns, LoseOffTheAxis) {
  const AntennaPattern pattern = read(kSmall);
  EXPECT_DOUBLE_EQ(off_axis_db(pattern, {0, 0}, 0), 0.5);
  EXPECT_DOUBLE_EQ(off_axis_db(pattern, {45, 0}, 0), 0.5 + 9.5 / 2);
  EXPECT_DOUBLE_EQ(off_axis_db(pattern, {-45, 0}, 0), 0.5 + 11.5 / 2);
  EXPECT_DOUBLE_EQ(off_axis_db(pattern, {360 - 45, 0}, 0), off_axis_db(pattern, {-45, 0}, 0));
  EXPECT_DOUBLE_EQ(off_axis_db(pattern, {0, -9}, 0), 0.5 + 19.5 / 10) << "below the horizontal";
  EXPECT_NEAR(off_axis_db(pattern, {0, -9}, 9), 0.5, 1e-12) << "tilted towards it";
  EXPECT_NEAR(off_axis_db(pattern, {0, 0}, 9), 0.5 + 21.5 / 10, 1e-12) << "above the axis";
  EXPECT_DOUBLE_EQ(off_axis_db(pattern, {180, 0}, 0), 0.5 + 24.5);
  EXPECT_NEAR(off_axis_db(pattern, {180, 0}, 9), 0.5 + 24.5 + 19.5 / 10, 1e-12) << "below the axis behind";
  EXPECT_DOUBLE_EQ(off_axis_db(pattern, {180, -80}, 0), 30) << "no more than the greatest loss";
}

TEST_F(AntennaPatterns, CountInBudgets) {
  const auto pattern = std::make_shared<const AntennaPattern>(read(kSmall));
  PathLosses losses;
  losses.free_space_db = 120;
  const RadioPath path{.frequency_ghz = 5.8, .effective_earth_km = 8494.667};
  const BudgetCourse course{10000, {300, 200}, 30.0};
  BudgetQuery query{.power_dbm = 20, .to_gain_dbi = 20, .from_antenna = {pattern}};
  const LinkBudget aimed = link_budget(losses, path, course, query);
  EXPECT_DOUBLE_EQ(aimed.eirp_dbm, 35);
  EXPECT_NEAR(aimed.from_off_axis_db, 0.5, 1e-12);
  query.from_antenna.azimuth_deg = 75, query.from_antenna.tilt_deg = 0;
  const LinkBudget aside = link_budget(losses, path, course, query);
  const double down = in_degrees(std::atan(100.0 / 10000 + 10000 / (2000 * 8494.667)));
  EXPECT_NEAR(aside.from_off_axis_db, off_axis_db(*pattern, {-45, -down}, 0), 1e-12);
  EXPECT_NEAR(aside.level_dbm, aimed.level_dbm - aside.from_off_axis_db + 0.5, 1e-12);
  query.from_antenna = {}, query.from_gain_dbi = 15;
  query.to_antenna = {pattern, 120};  // the first end is at 210 degrees
  EXPECT_NEAR(link_budget(losses, path, course, query).to_off_axis_db, 10, 0.2);
  EXPECT_THROW(link_budget(losses, path, {10000, {300, 200}}, query), InputError);
  query.to_antenna = {pattern};
  for (const auto& [ghz, is_near] : {std::pair(4.0, true), {8.6, true}, {3.8, false}, {8.8, false}, {0.9, false}}) {
    const RadioPath other{.frequency_ghz = ghz, .effective_earth_km = 8494.667};
    if (is_near) {
      EXPECT_NO_THROW(link_budget(losses, other, course, query)) << ghz;
    } else {
      EXPECT_THROW(link_budget(losses, other, course, query), InputError) << ghz;
    }
  }
  const auto in_ghz = std::make_shared<AntennaPattern>(*pattern);
  in_ghz->frequency_mhz = 5.8;
  query.to_antenna = {in_ghz};
  EXPECT_NO_THROW(link_budget(losses, path, course, query)) << "stated in GHz";
}

}  // namespace

}  // namespace itin::profile
