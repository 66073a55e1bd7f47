#include "chart/bar_chart_layout.hpp"

#include <algorithm>

#include "drawing/palette.hpp"

namespace itin::bars {

namespace {

using profile::Align;
using profile::Lettering;

constexpr double kWidth = 780, kMargin = 16, kGap = 6;
constexpr double kLongestName = 230;  ///< how wide the name of a group may be
constexpr double kBar = 9, kBarPitch = 11, kGroupGap = 9;
constexpr double kLegendLine = 14, kSwatch = 8;
constexpr int kMostTicks = 8;

class Page {
 public:
  explicit Page(const BarChart& chart) : chart_(chart) {}

  BarChartLayout run() {
    layout_.width = kWidth;
    place_title();
    place_legend();
    place_frame();
    place_bars();
    place_axis();
    return std::move(layout_);
  }

 private:
  void add(Point2 anchor, const std::string& text, const Lettering& lettering, double width) {
    layout_.texts.push_back({anchor, measure_.fitted(text, width, lettering), lettering});
  }

  void place_title() {
    add({kMargin, 22}, chart_.title, {.size = 12, .colour = profile::kInk, .bold = true}, kWidth - 2 * kMargin);
    add({kMargin, 36}, chart_.note, note_, kWidth - 2 * kMargin);
    y_ = 48;
  }

  /// Places the names of the series, in as many lines as they need.
  void place_legend() {
    double x = kMargin;
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      const double wide = kSwatch + kGap + measure_.text_width(chart_.series[i], name_) + 3 * kGap;
      if (x > kMargin && x + wide > kWidth - kMargin) {
        x = kMargin;
        y_ += kLegendLine;
      }
      layout_.swatches.push_back({{x, y_, x + kSwatch, y_ + kSwatch}, i});
      add({x + kSwatch + kGap, y_ + kSwatch}, chart_.series[i], name_, kWidth - kMargin - x - kSwatch - kGap);
      x += wide;
    }
    y_ += kLegendLine + kGap;
  }

  /// Leaves room for the groups' names to the left of the frame, and for the text of the longest bar to its right.
  void place_frame() {
    double names = 0, texts = 0, bars = 0, most = chart_.line.value_or(0);
    for (const BarGroup& group : chart_.groups) {
      names = std::max(names, std::min(measure_.text_width(group.name, name_), kLongestName));
      bars += static_cast<double>(group.bars.size()) * kBarPitch + kGroupGap;
      for (const Bar& bar : group.bars) {
        texts = std::max(texts, measure_.text_width(bar.text, text_));
        most = std::max(most, bar.value);
      }
    }
    layout_.frame = {kMargin + names + kGap, y_, kWidth - kMargin - texts - kGap, y_ + bars + kGroupGap};
    layout_.axis = {0, most > 0 ? most : 1, layout_.frame.xmin, layout_.frame.xmax};
  }

  void place_bars() {
    double y = layout_.frame.ymin + kGroupGap;
    for (const BarGroup& group : chart_.groups) {
      const double middle = y + static_cast<double>(group.bars.size()) * kBarPitch / 2;
      Lettering name = name_;
      name.align = Align::kRight;
      add({layout_.frame.xmin - kGap, middle + name.size / 3}, group.name, name, kLongestName);
      for (const Bar& bar : group.bars) {
        const double end = layout_.axis.at(bar.value);
        layout_.bars.push_back({{layout_.frame.xmin, y, end, y + kBar}, bar.series});
        layout_.clearings.push_back({end, y, end + kGap + measure_.text_width(bar.text, text_), y + kBar});
        add({end + kGap / 2, y + kBar - 2}, bar.text, text_, kWidth - kMargin - end);
        y += kBarPitch;
      }
      y += kGroupGap;
    }
  }

  void place_axis() {
    const Box& frame = layout_.frame;
    const double step = layout_.axis.step(kMostTicks);
    layout_.ticks = layout_.axis.ticks(kMostTicks);
    Lettering label = note_;
    label.align = Align::kCentre;
    for (const double tick : layout_.ticks) {
      add({layout_.axis.at(tick), frame.ymax + 12}, profile::tick_label(tick, step), label, kWidth);
    }
    add({frame.xmin, frame.ymax + 26}, chart_.axis, note_, kWidth - kMargin - frame.xmin);
    layout_.height = frame.ymax + 26 + kMargin;
  }

  const BarChart& chart_;
  const profile::Drawing measure_{profile::Drawing::Format::kSvg, 1, 1};
  const Lettering name_{.size = 9, .colour = profile::kInk};
  const Lettering text_{.size = 7.5, .colour = profile::kInk};
  const Lettering note_{.size = 8, .colour = profile::kFaint};
  BarChartLayout layout_;
  double y_ = 0;  ///< where the next part begins
};

}  // namespace

BarChartLayout lay_out(const BarChart& chart) {
  return Page(chart).run();
}

}  // namespace itin::bars
