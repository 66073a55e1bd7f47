#include "import/points/point_source.hpp"

#include <itin/error.hpp>
#include <itin/file_ending.hpp>

#include "import/lidar/las_reader.hpp"
#include "import/points/delimited_text.hpp"
#include "import/points/point_layer.hpp"
#include "import/points/scattered_source.hpp"

namespace itin {

bool is_delimited_text(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".csv" || ending == ".xyz" || ending == ".txt" || ending == ".tsv";
}

std::unique_ptr<SourceFile> open_point_source(const std::string& path, const ImportOptions& options) {
  if (!is_delimited_text(path)) return scattered_source(open_point_layer(path, options), options);
  return scattered_source(std::make_unique<DelimitedText>(path, options.z_field), options);
}

std::unique_ptr<SourceFile> open_las_source(const std::string& path, const ImportOptions& options) {
  return scattered_source(open_las_reader(path, options), options);
}

}  // namespace itin
