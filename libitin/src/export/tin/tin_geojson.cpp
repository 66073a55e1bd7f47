#include <string>
#include <vector>

#include "export/buffered_file.hpp"
#include "export/export_metadata.hpp"
#include "export/step_progress.hpp"
#include "export/tin/tin_formats.hpp"

namespace itin {

namespace {

/// Writes a triangle; `themes` are the themes' names as JSON strings.
void write_feature(const Tin& tin, std::size_t triangle, const std::vector<std::string>& themes, BufferedFile& file) {
  const auto [a, b, c] = tin.triangles[triangle];
  file.print(R"({{"type":"Feature","id":{},"properties":{{"vertex_a":{},"vertex_b":{},"vertex_c":{},)", triangle,
             tin.id(a), tin.id(b), tin.id(c));
  file.print(R"("source_a":{},"source_b":{},"source_c":{})", tin.sources[a], tin.sources[b], tin.sources[c]);
  if (!tin.raised_theme.empty()) file.print(R"(,"theme":{})", themes[tin.theme(tin.triangles[triangle])]);
  file.write("},");
  file.write(R"("geometry":{"type":"Polygon","coordinates":[[)");
  const char* separator = "";
  for (const std::uint32_t v : {a, b, c, a}) {
    const Point3 p = tin.point(v);
    file.print("{}[{},{},{}]", separator, p.x, p.y, p.z);
    separator = ",";
  }
  file.write("]]}}");
}

void write_line(const Tin& tin, std::size_t line, const TinExportOptions& options, BufferedFile& file) {
  const LineEdge& e = tin.lines[line];
  const nlohmann::ordered_json theme =
      e.theme <= options.theme_names.size() ? options.theme_names[e.theme - std::size_t{1}] : "";
  const Point3 a = tin.point(e.from), b = tin.point(e.to);
  file.print(R"({{"type":"Feature","id":{},"properties":{{"vertex_a":{},"vertex_b":{},"theme":{}}},)",
             tin.triangles.size() + line, tin.id(e.from), tin.id(e.to), dumped(theme));
  file.print(R"("geometry":{{"type":"LineString","coordinates":[[{},{},{}],[{},{},{}]]}}}})", a.x, a.y, a.z, b.x, b.y,
             b.z);
}

}  // namespace

void write_geojson(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress) {
  const nlohmann::ordered_json metadata = parsed_metadata(options.metadata_json);
  const std::string urn = crs_urn(options.crs_wkt);
  BufferedFile file(output);
  file.write(R"({"type":"FeatureCollection","name":"triangles",)");
  if (!urn.empty()) file.print(R"("crs":{{"type":"name","properties":{{"name":"{}"}}}},)", urn);
  if (!metadata.empty()) file.print(R"("metadata":{},)", dumped(metadata));
  file.write("\"features\":[");
  StepProgress steps(progress, tin.triangles.size() + tin.lines.size());
  std::vector<std::string> themes{"null"};
  for (const std::string& name : options.theme_names) themes.push_back(dumped(name));
  for (std::size_t t = 0; t < tin.triangles.size(); ++t) {
    file.write(t == 0 ? "\n" : ",\n");
    write_feature(tin, t, themes, file);
    steps.step();
  }
  for (std::size_t e = 0; e < tin.lines.size(); ++e) {
    file.write(tin.triangles.empty() && e == 0 ? "\n" : ",\n");
    write_line(tin, e, options, file);
    steps.step();
  }
  file.write("\n]}\n");
  file.close();
}

}  // namespace itin
