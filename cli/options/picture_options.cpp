#include "options/picture_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/triangulate.hpp>

#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void PictureOptions::declare(CLI::App& app, const std::string& of) {
  begin_group(app, "Picture");
  writes(app.add_option("--image", path_, "A picture of " + of + " (.png, .jpg, ...), seen obliquely from afar")
             ->type_name("FILE"));
  app.add_flag("--edges", edges_, "Draw the edges of all triangles into the picture");
  app.add_option("--eye", eye_text_, "Draw what is seen from here, h metres above the ground")->type_name("x,y,h");
  app.add_option(
         "--look", look_,
         "Where the picture's viewer looks, degrees: from how high above the horizon (default: 340,40), or with "
         "--eye how far upwards (default: 0,0)")
      ->type_name("AZIMUTH,DEGREES");
  app.add_option("--field", field_text_, "How wide the view from --eye is (default: 60)")->type_name("DEGREES");
}

void PictureOptions::validate() {
  for (const auto& [given, option] :
       {std::pair(edges_, "--edges"), std::pair(!eye_text_.empty(), "--eye"), std::pair(!look_.empty(), "--look")})
    if (given && path_.empty()) throw InputError(fmt::format("{}: give --image FILE.png with it", option));
  if (!field_text_.empty() && eye_text_.empty()) throw InputError("--field: give --eye x,y,h with it");
  if (path_.empty()) return;
  viewshed::require_image_format(path_);
  oblique_.edges = edges_;
  if (!eye_text_.empty()) {
    const std::vector<double> eye = parse_tuple("--eye", eye_text_, 3, "x,y,h");
    perspective_ = viewshed::PerspectiveOptions{.eye = {eye[0], eye[1], eye[2]}, .edges = edges_};
    if (!field_text_.empty()) perspective_->field = parse_number("--field", field_text_, Range::kPositive);
  }
  if (look_.empty()) return;
  const std::vector<double> look =
      parse_tuple("--look", look_, 2, perspective_ ? "azimuth,pitch" : "azimuth,elevation");
  if (perspective_) {
    perspective_->azimuth = look[0], perspective_->pitch = look[1];
  } else {
    oblique_.azimuth = look[0], oblique_.elevation = look[1];
  }
}

viewshed::MapImage PictureOptions::draw(const Store& store, const Tin& tin, const Detail& detail,
                                        Progress& progress) const {
  std::vector<ThemeKind> kinds;
  for (const ThemeInfo& theme : store.metadata().themes) kinds.push_back(theme.kind);
  if (!perspective_) {
    viewshed::ObliqueOptions options = oblique_;
    options.kinds = std::move(kinds);
    return viewshed::draw_oblique(tin, options);
  }
  viewshed::PerspectiveOptions options = *perspective_;
  options.kinds = std::move(kinds);
  const auto ground =
      heights_at(store, {{options.eye.x, options.eye.y}}, detail, ThemeChoice::none(), progress).front();
  if (!ground) throw InputError(fmt::format("--eye '{}': there is no ground below it", eye_text_));
  options.eye.z += *ground;
  return viewshed::draw_perspective(tin, options);
}

void PictureOptions::write(const Store& store, const Tin& tin, const Detail& detail, bool overwrite,
                           Progress& progress) const {
  viewshed::write_image(path_, draw(store, tin, detail, progress), overwrite);
}

}  // namespace itin::cli
