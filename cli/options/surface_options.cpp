#include "options/surface_options.hpp"

#include <itin/feature_at.hpp>
#include <itin/silent_progress.hpp>

#include "options/omitted_features.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"

namespace itin::cli {

void ThemeOptions::declare(CLI::App& app) {
  begin_group(app, kSurface);
  app.add_option(
         "--themes", themes_,
         "Surface features to include: all (the default), none, or their names. Lines of the terrain are always "
         "included; lines that only lie on it, such as roads, change no height and matter to itin tin alone")
      ->type_name("NAME,NAME...");
  reads(app.add_option("--without", without_texts_,
                       "What would be were these features not there: the ground beneath takes their place. "
                       "THEME:ID or THEME:NAME as reports print them, or THEME#NUMBER, with semicolons between; or a "
                       "file with one in each line; may be given again")
            ->type_name("FEATURES")
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
}

void ThemeOptions::validate() {
  choice_ = ThemeChoice::parse(themes_);
  without_.clear();
  for (const std::string& text : without_texts_)
    for (std::string& name : omitted_in(text)) without_.push_back(std::move(name));
}

void ThemeOptions::complete(const Store& store, Progress& progress) {
  if (without_.empty()) return;
  choice_.check(store.metadata().themes);
  SilentProgress quiet(progress);
  choice_ = without_features(store, choice_, features_called(store, without_), quiet);
}

Document ThemeOptions::parameters() const {
  Document parameters{{"themes", themes_}};
  if (!without_.empty()) parameters["without"] = without_;
  return parameters;
}

}  // namespace itin::cli
