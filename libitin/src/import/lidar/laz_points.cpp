#include "import/lidar/laz_points.hpp"

#include <algorithm>
#include <pdal/Options.hpp>
#include <pdal/PointTable.hpp>
#include <pdal/filters/StreamCallbackFilter.hpp>
#include <pdal/io/LasReader.hpp>
#include <pdal/pdal_types.hpp>
#include <vector>

#include <itin/error.hpp>

namespace itin {

namespace {

constexpr std::size_t kPointsPerBatch = 16384;

/// Reads a point's flags. Versions of PDAL differ in where they put them: in the class byte, in ClassFlags or in a
/// dimension of their own. Dimensions that a version lacks are `Unknown`.
class PdalPoint {
 public:
  PdalPoint(const pdal::PointLayoutPtr& layout, int point_format)
      : flags_(layout->findDim("ClassFlags")), withheld_(layout->findDim("Withheld")), legacy_(point_format < 6) {}

  LasPoint operator()(const pdal::PointRef& point) const {
    using pdal::Dimension::Id;
    const auto field = [&](Id id) { return id == Id::Unknown ? 0 : point.getFieldAs<int>(id); };
    const int classification = field(Id::Classification);
    LasPoint result;
    result.x = point.getFieldAs<double>(Id::X);
    result.y = point.getFieldAs<double>(Id::Y);
    result.z = point.getFieldAs<double>(Id::Z);
    result.classification = static_cast<std::uint8_t>(legacy_ ? classification & 0x1f : classification);
    result.withheld = (legacy_ && (classification & 0x80) != 0) || (field(flags_) & 0x04) != 0 || field(withheld_) != 0;
    return result;
  }

 private:
  pdal::Dimension::Id flags_, withheld_;
  bool legacy_;
};

}  // namespace

void read_laz(const LasFile& file, const LasFile::Sink& sink) {
  std::vector<LasPoint> batch;
  std::uint64_t done = 0;
  const auto hand_on = [&] {
    done += batch.size();
    sink(batch, std::min(1.0, static_cast<double>(done) / static_cast<double>(file.header().point_count)));
    batch.clear();
  };
  try {
    pdal::Options options;
    options.add("filename", file.path());
    pdal::LasReader reader;
    reader.setOptions(options);
    pdal::StreamCallbackFilter callback;
    callback.setInput(reader);
    pdal::FixedPointTable table(kPointsPerBatch);
    callback.prepare(table);
    const PdalPoint decode(table.layout(), file.header().point_format);
    callback.setCallback([&](pdal::PointRef& point) {
      batch.push_back(decode(point));
      if (batch.size() == kPointsPerBatch) hand_on();
      return true;
    });
    callback.execute(table);
  } catch (const pdal::pdal_error& error) {
    throw FileError(file.path(), error.what());
  }
  if (!batch.empty()) hand_on();
  if (done != file.header().point_count) throw FileError(file.path(), "the compressed point data end early");
}

}  // namespace itin
