#include "report/charts/location_figure.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <itin/counted.hpp>

#include "report/charts/chart_frame.hpp"
#include "sheet/map_frame.hpp"
#include "sheet/map_symbols.hpp"
#include "sheet/paper.hpp"

namespace itin::profile {

namespace {

constexpr double kTitle = 30, kBeside = 14, kReferences = 24, kLine = 10;  ///< points
constexpr double kSample = 15, kSampleHeight = 6, kBetween = 10;           ///< the legend's lengths, points
const Lettering kCaption{7.5, kReportGrey, Align::kLeft, false, 0};

/// The rows of a legend without its headings, beside each other as far as there is room.
class Legend {
 public:
  Legend(Drawing& drawing, const MapSheet& map, double width) : drawing_(drawing) {
    double x = 0;
    for (const SheetKey& key : map.legend) {
      if (key.sample == SheetKey::Sample::kHeading) continue;
      const double wide = kSample + drawing.text_width(key.text, kCaption);
      if (x > 0 && x + wide > width) x = 0, ++lines_;
      keys_.push_back({&key, x, lines_ * kLine});
      x += wide + kBetween;
    }
  }

  double height() const { return keys_.empty() ? 0 : (lines_ + 1) * kLine; }

  /// Draws it below `corner`.
  void draw(Point2 corner) const {
    for (const auto& [key, right, down] : keys_) {
      const double x = corner.x + right, y = corner.y + down + kLine / 2;
      draw_sample(drawing_, *key, {x, y - kSampleHeight / 2, x + kSample - 4, y + kSampleHeight / 2}, 0.8);
      drawing_.text({x + kSample, y + 0.35 * kCaption.size}, key->text, kCaption);
    }
  }

 private:
  struct Placed {
    const SheetKey* key;
    double right, down;
  };

  Drawing& drawing_;
  std::vector<Placed> keys_;
  int lines_ = 0;
};

}  // namespace

void draw_location(Drawing& drawing, const Box& area, const MapSheet& map) {
  drawing.text({area.xmin, area.ymin + 10}, map.title.title, {10, kReportInk, Align::kLeft, true, 0});
  Paper paper = paper_of(map.paper);
  const Legend legend(drawing, map, area.width());
  // The figure shows the ground of the sheet: all that the legend names, and there are no more cells.
  const Box ground = ground_in_frame(map);
  const double below = kReferences + kLine + legend.height();
  const Point2 corner{area.xmin + kBeside, area.ymin + kTitle};
  const Box room{corner.x, corner.y, area.xmax - kBeside, area.ymax - below};
  const double scale = usual_scale_within(room, ground), points = 1000 * kPointsPerMillimetre / scale;
  paper.frame = {corner.x, corner.y, corner.x + points * ground.width(), corner.y + points * ground.height()};
  MapFrame frame(drawing, paper, ground);
  frame.draw(map);
  const double y = paper.frame.ymax + kReferences;
  const std::string left_out = frame.left_out();
  drawing.text({area.xmin, y},
               fmt::format("1:{} at {}; grid north is up{}{}", grouped(static_cast<std::uint64_t>(std::lround(scale))),
                           paper.name, left_out.empty() ? "" : "; ", left_out),
               kCaption);
  legend.draw({area.xmin, y + 2});
}

}  // namespace itin::profile
