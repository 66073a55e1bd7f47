#include <cmath>

#include <itin/file_ending.hpp>
#include <itin/vector_export.hpp>

#include "export/buffered_file.hpp"
#include "export/export_metadata.hpp"

namespace itin {

namespace {

nlohmann::ordered_json json_of(const VectorLayer::Value& value) {
  if (const auto* number = std::get_if<double>(&value); number != nullptr && std::isfinite(*number)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return nullptr;
}

void write_positions(const std::vector<Point3>& points, BufferedFile& file) {
  const char* separator = "";
  for (const Point3& p : points) {
    file.print("{}[{},{},{}]", separator, p.x, p.y, p.z);
    separator = ",";
  }
}

}  // namespace

void require_crs_for(const std::string& path, const std::string& crs_wkt) {
  if (ending_of(path) == ".geojson") crs_urn(crs_wkt);
}

void write_geojson(const std::string& path, const std::string& crs_wkt, const VectorLayer& layer, bool overwrite) {
  PendingFile output(path, overwrite);
  const std::string urn = crs_urn(crs_wkt);
  BufferedFile file(output);
  file.print(R"({{"type":"FeatureCollection","name":{},)", dumped(layer.name));
  if (!urn.empty()) file.print(R"("crs":{{"type":"name","properties":{{"name":"{}"}}}},)", urn);
  file.write("\"features\":[");
  const bool points = layer.shape == VectorLayer::Shape::kPoints;
  const char* separator = "\n";
  for (const VectorLayer::Feature& feature : layer.features) {
    nlohmann::ordered_json properties = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < layer.fields.size(); ++i)
      properties[layer.fields[i].first] = json_of(feature.values[i]);
    file.print(R"({}{{"type":"Feature","properties":{},"geometry":{{"type":"{}","coordinates":)", separator,
               dumped(properties), points ? "Point" : "LineString");
    if (!points) file.write("[");
    write_positions(feature.points, file);
    file.write(points ? "}}" : "]}}");
    separator = ",\n";
  }
  file.write("\n]}\n");
  file.close();
  output.commit();
}

}  // namespace itin
