#include "export/buffered_file.hpp"
#include "export/step_progress.hpp"
#include "export/tin/tin_formats.hpp"

namespace itin {

void write_2dm(const Tin& tin, const PendingFile& output, const TinExportOptions&, Progress& progress) {
  BufferedFile file(output);
  file.print("MESH2D\nNUM_MATERIALS_PER_ELEM 1\n");
  StepProgress steps(progress, tin.vertices.size() + tin.triangles.size());
  for (std::uint32_t v = 0; v < tin.vertices.size(); ++v) {
    const Point3 p = tin.point(v);
    file.print("ND {} {} {} {}\n", v + 1, p.x, p.y, p.z);
    steps.step();
  }
  for (std::size_t t = 0; t < tin.triangles.size(); ++t) {
    const auto& [a, b, c] = tin.triangles[t];
    file.print("E3T {} {} {} {} {}\n", t + 1, a + 1, b + 1, c + 1, tin.theme(tin.triangles[t]) + 1);
    steps.step();
  }
  file.close();
}

}  // namespace itin
