#include <filesystem>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/antenna_columns.hpp>
#include <profile/antenna_loss.hpp>

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
  if (antenna.tilt_deg && !is_tilt(*antenna.tilt_deg))
    throw InputError(fmt::format("{}: its tilt of {:g} is beyond {:g} degrees", where, *antenna.tilt_deg, kMostTilt));
  if (antenna.azimuth_deg && !is_azimuth(*antenna.azimuth_deg))
    throw InputError(fmt::format("{}: its azimuth of {:g} is not one from {:g} to {:g} degrees", where,
                                 *antenna.azimuth_deg, kLeastAzimuth, kMostAzimuth));
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
