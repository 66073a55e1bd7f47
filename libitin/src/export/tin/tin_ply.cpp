#include "export/buffered_file.hpp"
#include "export/export_metadata.hpp"
#include "export/step_progress.hpp"
#include "export/tin/tin_formats.hpp"

namespace itin {

void write_ply(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress) {
  BufferedFile file(output);
  file.print("ply\nformat binary_little_endian 1.0\ncomment itin {}\n", ITIN_VERSION);
  if (!options.crs_wkt.empty()) file.print("comment crs {}\n", on_one_line(options.crs_wkt));
  file.print("comment id = id_high * 4294967296 + id_low\nelement vertex {}\n", tin.vertices.size());
  for (const char* axis : {"x", "y", "z"}) file.print("property double {}\n", axis);
  file.print("property uint id_high\nproperty uint id_low\nproperty ushort source\n");
  file.print("element face {}\nproperty list uchar int vertex_indices\n", tin.triangles.size());
  if (!tin.raised_theme.empty()) file.print("property ushort theme\n");
  if (!tin.lines.empty()) {
    for (std::size_t t = 0; t < options.theme_names.size(); ++t)
      file.print("comment theme {} {}\n", t + 1, on_one_line(options.theme_names[t]));
    file.print("element edge {}\nproperty int vertex1\nproperty int vertex2\nproperty ushort theme\n",
               tin.lines.size());
  }
  file.print("end_header\n");

  StepProgress steps(progress, tin.vertices.size() + tin.triangles.size() + tin.lines.size());
  for (std::uint32_t v = 0; v < tin.vertices.size(); ++v) {
    const Point3 p = tin.point(v);
    const VertexId id = tin.id(v);
    file.little_endian(p.x);
    file.little_endian(p.y);
    file.little_endian(p.z);
    file.little_endian(static_cast<std::uint32_t>(id >> 32));
    file.little_endian(static_cast<std::uint32_t>(id));
    file.little_endian(tin.sources[v]);
    steps.step();
  }
  for (const Triangle& t : tin.triangles) {
    file.little_endian(std::uint8_t{3});
    for (const std::uint32_t v : t) file.little_endian(v);
    if (!tin.raised_theme.empty()) file.little_endian(tin.theme(t));
    steps.step();
  }
  for (const LineEdge& e : tin.lines) {
    file.little_endian(e.from);
    file.little_endian(e.to);
    file.little_endian(e.theme);
    steps.step();
  }
  file.close();
}

}  // namespace itin
