#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/antenna_columns.hpp>

namespace itin::profile {

AntennaColumns::AntennaColumns(SiteQuery& query)
    : path_(query.path), number_(query.numbers.size()), text_(query.texts.size()) {
  query.numbers.push_back({"azimuth", false});
  query.numbers.push_back({"tilt", false});
  query.texts.emplace_back("antenna");
}

AimedAntenna AntennaColumns::of(const Site& site) {
  AimedAntenna antenna{nullptr, site.numbers[number_], site.numbers[number_ + 1]};
  const std::string where = fmt::format("{}: {}", path_, site.place);
  if (antenna.tilt_deg && std::abs(*antenna.tilt_deg) > 90)
    throw InputError(fmt::format("{}: its tilt of {:g} is beyond 90 degrees", where, *antenna.tilt_deg));
  if (antenna.azimuth_deg && !(*antenna.azimuth_deg >= -180 && *antenna.azimuth_deg <= 360))
    throw InputError(
        fmt::format("{}: its azimuth of {:g} is not one from -180 to 360 degrees", where, *antenna.azimuth_deg));
  const std::string& file = site.texts[text_];
  if (file.empty()) return antenna;
  std::shared_ptr<const AntennaPattern>& pattern = patterns_[file];
  if (!pattern) {
    const std::filesystem::path path = std::filesystem::path(path_).parent_path() / file;
    try {
      pattern = std::make_shared<const AntennaPattern>(read_antenna_pattern(path.string()));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", where, error.what()));
    } catch (const FileError& error) {
      throw FileError(where, error.what());
    }
  }
  antenna.pattern = pattern;
  return antenna;
}

}  // namespace itin::profile
