#include "output/web_map.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>

#include <itin/filling_grid.hpp>
#include <itin/label_places.hpp>
#include <itin/markup.hpp>
#include <itin/round_length.hpp>

#include "output/web_layers.hpp"

namespace itin::cli {

// Later maps use parts of the first. A rule that names what is about an element holds in the first alone, so that
// elements of maps have classes of their own.
const char* const kWebMapStyle =
    "figure{margin:.8rem 0}.map{display:block;width:100%;height:auto;background:#ededf2;outline:1px solid #555}"
    ".map-cells{image-rendering:pixelated}.map-text{font:600 12px system-ui,sans-serif;fill:#1e1e1e;stroke:#fff;"
    "stroke-width:3px;paint-order:stroke;stroke-linejoin:round}.scale{box-sizing:border-box;border:1px solid #1e1e1e;"
    "border-top:0;text-align:center;font-size:.8rem;margin:.3rem 0 .5rem;line-height:1.1}.key{list-style:none;"
    "margin:.3rem 0;padding:0;display:flex;flex-wrap:wrap;gap:.15rem 1.3rem;font-size:.9rem}"
    ".key li{display:flex;align-items:center;gap:.4rem}.key .heading{width:100%;font-weight:600}"
    ".key svg{width:24px;height:16px;flex:none}@media(max-width:600px){.map-roomy{display:none}}";

namespace {

using profile::SheetKey;
using profile::SheetMark;

constexpr double kPageWidth = 990, kPhoneWidth = 358;  ///< the widths of a map, pixels
constexpr double kLetterWidth = 7.2, kLetterHeight = 14, kBeside = 10;

/// The labels of marks, beside them and none over another. There are fewer on a phone, which has less room.
class WebLabels {
 public:
  WebLabels(const Box& frame, const std::vector<profile::SheetLayer>& layers) : frame_(frame) {
    // Layers that are drawn last matter most.
    for (std::size_t i = layers.size(); i-- > 0;)
      if (const auto* some = std::get_if<profile::SheetMarks>(&layers[i]))
        for (const SheetMark& mark : some->marks) marks_.push_back(&mark);
    on_page_ = that_fit(kPageWidth, [&](const SheetMark& mark) {
      const bool left = across(mark) > 0.7;
      return std::vector{left ? kLeft : kRight, left ? kRight : kLeft};
    });
    on_phone_ = that_fit(kPhoneWidth, [&](const SheetMark& mark) {
      const auto on_page = on_page_.find(&mark);
      return on_page == on_page_.end() ? std::vector<Side>() : std::vector{on_page->second};
    });
  }

  /// A phrase about names that have no room even on a page; empty where all names have room.
  std::string left_out() const {
    const auto names = static_cast<std::size_t>(
        std::count_if(marks_.begin(), marks_.end(), [](const SheetMark* mark) { return !mark->label.empty(); }));
    return on_page_.size() < names ? left_out_text(names - on_page_.size(), names) : "";
  }

  std::string svg() const {
    std::string text;
    for (const SheetMark* mark : marks_) {
      const auto on_page = on_page_.find(mark);
      if (on_page == on_page_.end()) continue;
      const bool left = on_page->second == kLeft;
      text += fmt::format("<text class=\"map-text{}\" x=\"{}\" y=\"{}\" dx=\"{}\" dy=\"4\"{}>{}</text>\n",
                          on_phone_.contains(mark) ? "" : " map-roomy", web_percent(across(*mark)),
                          web_percent(down(*mark)), left ? -kBeside : kBeside, left ? " text-anchor=\"end\"" : "",
                          escaped_markup(mark->label));
    }
    return text;
  }

 private:
  enum Side { kLeft, kRight };
  using Sides = std::map<const SheetMark*, Side>;

  double across(const SheetMark& mark) const { return (mark.at.x - frame_.xmin) / frame_.width(); }
  double down(const SheetMark& mark) const { return (frame_.ymax - mark.at.y) / frame_.height(); }

  /// Returns the sides of the names that have room at this width. A name takes the first of `sides_of(mark)` where it
  /// has.
  template <class SidesOf>
  Sides that_fit(double width, const SidesOf& sides_of) const {
    const double height = width * frame_.height() / frame_.width();
    const auto at = [&](const SheetMark& mark) { return Point2{across(mark) * width, down(mark) * height}; };
    LabelPlaces places;
    for (const SheetMark* mark : marks_) {
      const Point2 p = at(*mark);
      places.take({p.x - kBeside / 2, p.y - kBeside / 2, p.x + kBeside / 2, p.y + kBeside / 2});
    }
    Sides fit;
    for (const SheetMark* mark : marks_) {
      if (mark->label.empty()) continue;
      const Point2 p = at(*mark);
      const double length = kLetterWidth * static_cast<double>(mark->label.size());
      for (const Side side : sides_of(*mark)) {
        const double from = side == kLeft ? p.x - kBeside - length : p.x + kBeside;
        const Box box{from, p.y - kLetterHeight / 2, from + length, p.y + kLetterHeight / 2};
        if (from < 0 || from + length > width || !places.free(box)) continue;
        places.take(box);
        fit.emplace(mark, side);
        break;
      }
    }
    return fit;
  }

  Box frame_;
  std::vector<const SheetMark*> marks_;
  Sides on_page_, on_phone_;
};

std::string key_html(const SheetKey& key) {
  const std::string text = escaped_markup(key.text);
  if (key.sample == SheetKey::Sample::kHeading) return fmt::format("<li class=\"heading\">{}</li>\n", text);
  return fmt::format("<li><svg aria-hidden=\"true\">{}</svg>{}</li>\n", profile::sample_svg(key, 24, 16), text);
}

std::string scale_bar(const Box& frame) {
  const double length = round_length(0.25 * frame.width());
  return fmt::format("<div class=\"scale\" style=\"width:{}\">{}</div>\n", web_percent(length / frame.width()),
                     length >= 1000 ? fmt::format("{:g} km", length / 1000) : fmt::format("{:g} m", length));
}

constexpr const char* kNorthArrow =
    "<svg x=\"100%\" overflow=\"visible\"><circle cx=\"-26\" cy=\"28\" r=\"20\" fill=\"#fff\" fill-opacity=\".8\"/>"
    "<path d=\"M-26 20l8 22-8-6-8 6z\" fill=\"#1e1e1e\"/><text class=\"map-text\" x=\"-26\" y=\"18\" "
    "text-anchor=\"middle\">N</text></svg>\n";

}  // namespace

WebMaps::WebMaps(const Store& store, const Box& frame, Progress& progress)
    : frame_(frame),
      base_(viewshed::plain_base(viewshed::relief(store, filling_grid(frame, kWebGroundPixels), progress))) {}

std::string WebMaps::part(std::string svg) {
  const auto [known, added] = parts_.emplace(std::move(svg), parts_.size() + 1);
  if (!added) return fmt::format("<use href=\"#map-part-{}\"/>\n", known->second);
  return fmt::format("<g id=\"map-part-{}\">{}</g>\n", known->second, known->first);
}

std::string WebMaps::figure(const viewshed::ResultSheet& content, const std::string& about) {
  const viewshed::MapBase base = viewshed::fitted(base_, content);
  const std::vector<profile::SheetLayer> layers = layers_of(base, content);
  std::string html =
      fmt::format("<figure>\n<svg class=\"map\" style=\"aspect-ratio:{:.6g}\" role=\"img\" aria-label=\"{}\">\n",
                  frame_.width() / frame_.height(), escaped_markup("Map: " + content.title.title));
  for (const profile::SheetLayer& layer : layers)
    html += part(web_layer(frame_, layer, &layer == &layers.front() ? WebPicture::kGround : WebPicture::kCells));
  const WebLabels labels(frame_, layers);
  html += part(labels.svg()) + part(kNorthArrow);
  html += "</svg>\n<figcaption>" + scale_bar(frame_);
  html +=
      fmt::format("<p><b>{}</b>: {}. <span class=\"note\">{}</span></p>\n<ul class=\"key\">\n",
                  escaped_markup(content.title.title), escaped_markup(about), escaped_markup(content.title.statement));
  for (const SheetKey& key : keys_of(base, content, frame_)) html += key_html(key);
  html += "</ul>";
  if (const std::string text = labels.left_out(); !text.empty()) html += "<p class=\"note\">" + text + "</p>";
  return html + "</figcaption>\n</figure>\n";
}

}  // namespace itin::cli
