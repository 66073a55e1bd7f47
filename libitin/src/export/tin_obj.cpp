#include "export/buffered_file.hpp"
#include "export/export_metadata.hpp"
#include "export/step_progress.hpp"
#include "export/tin_formats.hpp"

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
  for (const Triangle& t : tin.triangles) {
    file.print("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    steps.step();
  }
  file.close();
}

}  // namespace itin
