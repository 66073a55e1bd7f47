#include "site/coverage_curve.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/markup.hpp>
#include <itin/round_length.hpp>
#include <viewshed/site_wording.hpp>

namespace itin::cli {

namespace {

/// Draws the curve. Lengths across are in percent of the page's width, lengths down in pixels, so that letters keep
/// their size on a phone.
class CoverageCurve {
 public:
  explicit CoverageCurve(const viewshed::SitePlan& r) : result_(r), total_(std::max(1.0, whole(r))) {
    const bool turbines = r.request.turbines.has_value();
    bound_ = static_cast<double>(turbines ? r.choice.lower_bound : existing(r) + r.choice.upper_bound) / total_;
    const auto most = static_cast<double>(turbines ? r.choice.value : existing(r) + r.choice.upper_bound);
    most_ = std::max(most, 1.0) / total_ * 1.08;
  }

  std::string svg() const {
    return fmt::format("<svg class=\"curve\" height=\"{}\" role=\"img\" aria-label=\"{}\">\n", kHeight,
                       viewshed::wording_of(result_.request).coverage_curve) +
           grid() + steps() + bound() + "</svg>\n";
  }

 private:
  static constexpr double kHeight = 300, kTop = 20, kBottom = 40, kLeft = 12, kRight = 96;

  /// Returns the value that counts as 100 %: all demand, or for heights seen, where there is no such total, the value
  /// of the choice.
  static double whole(const viewshed::SitePlan& r) {
    return static_cast<double>(r.request.sums_heights() ? r.choice.value : r.inputs.total);
  }
  /// Returns what counts besides the chosen sites: what sees existing turbines does not.
  static viewshed::Weight existing(const viewshed::SitePlan& r) { return r.request.turbines ? 0 : r.choice.existing; }
  std::size_t sites() const { return result_.choice.chosen.size(); }
  /// Returns the share that the first sites serve, with the existing ones.
  double share(std::size_t sites) const {
    const viewshed::Weight chosen = sites == 0 ? 0 : result_.choice.chosen[sites - 1].cumulative;
    return static_cast<double>(existing(result_) + chosen) / total_;
  }
  double across(std::size_t site) const {
    return kLeft +
           (kRight - kLeft) * static_cast<double>(site) / static_cast<double>(std::max<std::size_t>(1, sites()));
  }
  double down(double share) const { return kHeight - kBottom - (kHeight - kTop - kBottom) * share / most_; }

  std::string grid() const {
    std::string svg;
    const double step = most_ > 0.5 ? 0.1 : most_ > 0.2 ? 0.05 : most_ > 0.05 ? 0.01 : round_length(most_ / 4);
    for (double at = 0; at <= most_; at += step)
      svg += fmt::format(
          "<line x1=\"{0}%\" y1=\"{2:.1f}\" x2=\"{1}%\" y2=\"{2:.1f}\" stroke=\"#ddd\"/>"
          "<text x=\"{0}%\" dx=\"-4\" y=\"{3:.1f}\" text-anchor=\"end\">{4:.3g}&#160;%</text>\n",
          kLeft, kRight, down(at), down(at) + 4, 100 * at);
    return svg;
  }

  /// Draws how much each site adds, with its name while there is room for names, then with every fifth number.
  std::string steps() const {
    constexpr std::size_t kNamed = 10, kShort = 4;
    std::string svg;
    for (std::size_t i = 1; i <= sites(); ++i) {
      svg += fmt::format(
          "<line x1=\"{0:.2f}%\" y1=\"{1:.1f}\" x2=\"{0:.2f}%\" y2=\"{2:.1f}\" stroke=\"#0072b2\" stroke-width=\"10\" "
          "stroke-opacity=\".25\"/><line x1=\"{3:.2f}%\" y1=\"{1:.1f}\" x2=\"{0:.2f}%\" y2=\"{2:.1f}\" "
          "stroke=\"#0072b2\" stroke-width=\"2.5\" stroke-linecap=\"round\"/>\n",
          across(i), down(share(i - 1)), down(share(i)), across(i - 1));
      if (sites() > kNamed && i % 5 != 0 && i > 1) continue;
      const std::string& name = result_.place_of(result_.choice.chosen[i - 1]).name;
      // A long name ends where the page does.
      const bool at_the_edge = i == sites() && sites() <= kNamed && name.size() > kShort;
      svg += fmt::format("<text x=\"{:.2f}%\" y=\"{}\" text-anchor=\"{}\">{}</text>\n", at_the_edge ? 100 : across(i),
                         kHeight - kBottom + 16, at_the_edge ? "end" : "middle",
                         sites() > kNamed ? fmt::format("{}", i) : escaped_markup(name));
    }
    return svg;
  }

  std::string bound() const {
    return fmt::format(
        "<line x1=\"{0}%\" y1=\"{2:.1f}\" x2=\"{1}%\" y2=\"{2:.1f}\" stroke=\"#d55e00\" stroke-dasharray=\"6 4\"/>"
        "<text x=\"{0}%\" dx=\"8\" y=\"{3:.1f}\" fill=\"#d55e00\">{4} {5:.1f} %</text>\n",
        kLeft, kRight, down(bound_), down(bound_) - 5, viewshed::wording_of(result_.request).bound, 100 * bound_);
  }

  const viewshed::SitePlan& result_;
  double total_, bound_ = 0, most_ = 1;
};

}  // namespace

std::string coverage_curve(const viewshed::SitePlan& r) {
  return CoverageCurve(r).svg();
}

}  // namespace itin::cli
