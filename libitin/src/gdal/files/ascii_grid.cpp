#include "gdal/files/ascii_grid.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin {

namespace {

/// Reads a number as GDAL does, which takes a comma for a point. Rasters of whole numbers have no NaN.
bool is_value(std::string text, bool whole) {
  std::replace(text.begin(), text.end(), ',', '.');
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), value);
  const bool number = end == text.data() + text.size() && error != std::errc::invalid_argument;
  return number && (!whole || std::isfinite(value));
}

/// Reads the header's names and numbers. Returns the first height.
std::string first_value(std::ifstream& file) {
  std::string word, value;
  while (file >> word) {
    if (std::isalpha(static_cast<unsigned char>(word.front())) == 0 || is_value(word, false)) return word;
    file >> value;
  }
  return {};
}

}  // namespace

void require_whole_ascii_grid(GDALDataset& raster, const std::string& path) {
  if (!EQUAL(raster.GetDriver()->GetDescription(), "AAIGrid")) return;
  std::ifstream file(path);
  if (!file) return;
  const std::int64_t columns = raster.GetRasterXSize(), count = columns * raster.GetRasterYSize();
  const bool whole = GDALDataTypeIsInteger(raster.GetRasterBand(1)->GetRasterDataType()) != 0;
  std::string value = first_value(file);
  for (std::int64_t i = 0; i < count; ++i, value.clear(), file >> value) {
    if (value.empty()) throw FileError(path, fmt::format("ends after {} of {} heights; it is cut short", i, count));
    if (!is_value(value, whole))
      throw FileError(path, fmt::format("row {}, column {}: '{:.20}' is no number that it can hold; mend the file, and "
                                        "mark missing heights by its NODATA_value",
                                        i / columns + 1, i % columns + 1, value));
  }
}

}  // namespace itin
