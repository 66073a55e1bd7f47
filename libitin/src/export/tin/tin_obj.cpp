#include "export/buffered_file.hpp"
#include "export/export_metadata.hpp"
#include "export/step_progress.hpp"
#include "export/tin/tin_formats.hpp"

namespace itin {

void write_obj(const Tin& tin, const PendingFile& output, const TinExportOptions& options, Progress& progress) {
  BufferedFile file(output);
  file.print("# itin {}\n", ITIN_VERSION);
  if (!options.crs_wkt.empty()) file.print("# crs {}\n", on_one_line(options.crs_wkt));
  StepProgress steps(progress, tin.vertices.size() + tin.triangles.size());
  for (std::uint32_t v = 0; v < tin.vertices.size(); ++v) {
    const Point3 p = tin.point(v);
    file.print("v {} {} {}\n", p.x, p.y, p.z);
    steps.step();
  }
  std::uint16_t group = 0;
  for (const Triangle& t : tin.triangles) {
    if (const std::uint16_t theme = tin.theme(t); theme != group) {
      file.print("g {}\n", theme == 0 ? "terrain" : on_one_line(theme_name(options, theme)));
      group = theme;
    }
    file.print("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    steps.step();
  }
  file.close();
}

}  // namespace itin
