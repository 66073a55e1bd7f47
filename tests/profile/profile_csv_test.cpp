#include <sstream>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

namespace {

Profile read(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> warnings;
  return read_profile_csv(stream, "p.csv", warnings);
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ProfileCsv, TakesHeaderOrNone) {
  for (const std::string header : {"", "d_km,h_m\n",
                                   "\xEF\xBB\xBF"
                                   "D_KM, H_M\r\n",
                                   "# a comment\n\nd_km,h_m\n"}) {
    const Profile profile = read(header + "0,100\n0.5,120.5\r\n1,+90\n");
    ASSERT_EQ(profile.points.size(), 3U) << header;
    EXPECT_EQ(profile.length_m, 1000);
    EXPECT_EQ(profile.points[1].distance_m, 500);
    EXPECT_EQ(profile.points[1].ground_m, 120.5);
    EXPECT_EQ(profile.points[2].clutter_m, 0);
  }
}

TEST(ProfileCsv, TakesClutterAndAnyOrigin) {
  const Profile profile = read("d_km,h_m,clutter_m\n10,1,0\n10.1,2,7.5\n10.1,5,0\n10.3,3,0");
  ASSERT_EQ(profile.points.size(), 4U);
  EXPECT_EQ(profile.points[0].distance_m, 0);
  EXPECT_NEAR(profile.length_m, 300, 1e-9);
  EXPECT_EQ(profile.points[1].clutter_m, 7.5);
  EXPECT_EQ(profile.points[1].distance_m, profile.points[2].distance_m);
}

TEST(ProfileCsv, NamesTheLineThatIsWrong) {
  EXPECT_EQ(refusal("d_km,h_m\n0,1\n1,x\n"), "p.csv, line 3: h_m 'x' is not a number");
  EXPECT_EQ(refusal("0,1\n1,nan\n"), "p.csv, line 2: h_m 'nan' is not a finite number");
  EXPECT_EQ(refusal("0,1\n2,1\n1,1\n"), "p.csv, line 3: d_km 1 is less than in the row before; distances must ascend");
  EXPECT_EQ(refusal("0,1,0\n1,1\n"), "p.csv, line 2: 2 columns where 3 were expected");
  EXPECT_EQ(refusal("0,1,0\n1,1,-2\n"), "p.csv, line 2: clutter_m is negative");
  EXPECT_EQ(refusal("0,1\n"), "p.csv: holds 1 row; a profile takes at least 2: its ends");
  EXPECT_EQ(refusal(""), "p.csv: holds 0 rows; a profile takes at least 2: its ends");
  EXPECT_NE(refusal("km,height\n0,1\n1,1\n").find("line 1: column 'km'"), std::string::npos);
  EXPECT_NE(refusal("1,1\n1,2\n").find("no length"), std::string::npos);
  EXPECT_NE(refusal("1\n2\n").find("line 1: 1 column;"), std::string::npos);
}

TEST(ProfileCsv, KnowsMetresFromKilometres) {
  for (const char* text : {"d_m,h_m\n0,1\n900,2\n", "Distance (m);Height (m)\n5;1\n905;2\n"})
    EXPECT_EQ(read(text).length_m, 900) << text;
  std::istringstream unnamed("0,1\n12500,2\n25000,3\n");
  std::vector<std::string> warnings;
  const Profile profile = read_profile_csv(unnamed, "p.csv", warnings);
  EXPECT_EQ(profile.length_m, 25000);
  EXPECT_EQ(profile.points[1].distance_m, 12500);
  EXPECT_EQ(warnings, std::vector<std::string>{"p.csv: its distances reach 25000 and are taken for metres, not "
                                               "kilometres; a header d_m,h_m or d_km,h_m states the unit"});
  EXPECT_EQ(refusal("d_km,h_m\n0,1\n25000,3\n").substr(0, 25), "p.csv: is 25000 km long, ");
}

TEST(ProfileCsv, TakesTheTextThatReportsWrite) {
  const Profile profile = read("0.000000\t102.30\t0.00\tN\n0.010000\t101.00\t7.50\tT\n0.020000\t99.00\t0.00\tN\n");
  ASSERT_EQ(profile.points.size(), 3U);
  EXPECT_EQ(profile.points[1].clutter_m, 7.5);
  EXPECT_NEAR(profile.length_m, 20, 1e-9);
}

TEST(ProfileCsv, TakesDecimalCommas) {
  const Profile profile = read("sep=;\nd_km;h_m\n0,000;\"101,5\"\n0,125;99\n");
  EXPECT_EQ(profile.length_m, 125);
  EXPECT_EQ(profile.points[0].ground_m, 101.5);
}

TEST(ProfileCsv, AFileThatIsNotThereIsAFileError) {
  std::vector<std::string> warnings;
  EXPECT_THROW(read_profile_csv("/nowhere/p.csv", warnings), FileError);
}

}  // namespace

}  // namespace itin::profile
