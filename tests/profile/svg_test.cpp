// SVGs as they are written: text as text, and no more bytes than a line takes.
#include <cmath>
#include <gmock/gmock.h>

#include <gtest/gtest.h>

#include <profile/chart.hpp>

namespace itin::profile {

namespace {

using testing::HasSubstr;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

Chart chart_of_hills() {
  Chart chart;
  chart.title = "Cwm & Mynydd <Meio>";
  chart.note = "over \"hills\"";
  Profile profile;
  profile.length_m = 9000;
  for (int i = 0; i <= 9000; ++i)
    profile.points.push_back({.distance_m = static_cast<double>(i), .ground_m = 200 + 80 * std::sin(i / 700.0)});
  chart.series = {{"full detail", profile}};
  return chart;
}

TEST(Svg, HasTextAsTextThatIsAsWideAsInAPdf) {
  const std::string svg = draw_chart(chart_of_hills(), "hills.svg");
  EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" width="));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_THAT(svg, HasSubstr(">Cwm &amp; Mynydd &lt;Meio&gt;</text>"));
  EXPECT_THAT(svg, HasSubstr(">over &quot;hills&quot;</text>"));
  EXPECT_EQ(count_of(svg, "<text "), count_of(svg, "</text>"));
  EXPECT_EQ(count_of(svg, "<text "), count_of(svg, " textLength=\""));
  EXPECT_EQ(count_of(svg, "<g "), count_of(svg, "</g>"));
}

TEST(Svg, LeavesOutPointsThatNobodyWouldMiss) {
  // A sine of 12.9 radians over some 750 points takes about 200 chords within a tenth of a pixel.
  EXPECT_LT(draw_chart(chart_of_hills(), "hills.svg").size(), 16000U);
}

}  // namespace

}  // namespace itin::profile
