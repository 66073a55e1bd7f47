// Which radio links of a table are in sight, as a table.
//
//   links town.itin links.csv judged.csv
#include <iostream>

#include <itin/itin.hpp>
#include <profile/links.hpp>

namespace {

using namespace itin;

void judge_links(const std::string& store_path, const std::string& links, const std::string& output) {
  NoProgress progress;
  const Store store(store_path);
  profile::LinkTable table = profile::read_link_table(links, store.metadata().crs_wkt, {2, 2});
  const profile::LinkSurvey survey = profile::survey_link_table(store, std::move(table), {}, progress);
  profile::write_link_table(survey, {output});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "links STORE.itin LINKS.csv OUTPUT.csv\n";
    return 2;
  }
  try {
    judge_links(argv[1], argv[2], argv[3]);
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
