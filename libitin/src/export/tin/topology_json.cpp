#include <itin/topology.hpp>

#include "export/buffered_file.hpp"
#include "export/export_metadata.hpp"
#include "export/step_progress.hpp"
#include "export/tin/tin_formats.hpp"

namespace itin {

namespace {

std::string index_or_null(std::optional<std::uint32_t> index) {
  return index ? fmt::format_int(*index).str() : std::string("null");
}

/// Writes ,"name":[item(0),item(1),...] with one item per line.
template <typename Item>
void write_array(BufferedFile& file, const char* name, std::size_t count, StepProgress& steps, const Item& write_item) {
  file.print(",\n\"{}\":[", name);
  for (std::size_t i = 0; i < count; ++i) {
    file.write(i == 0 ? "\n" : ",\n");
    write_item(static_cast<std::uint32_t>(i));
    steps.step();
  }
  file.write("]");
}

void write_vertices(const Tin& tin, BufferedFile& file, StepProgress& steps) {
  const std::size_t count = tin.vertices.size();
  write_array(file, "vertex_ids", count, steps, [&](std::uint32_t v) { file.print("\"{}\"", tin.id(v)); });
  write_array(file, "sources", count, steps, [&](std::uint32_t v) { file.print("{}", tin.sources[v]); });
  write_array(file, "vertices", count, steps, [&](std::uint32_t v) {
    const Point3 p = tin.point(v);
    file.print("[{},{},{}]", p.x, p.y, p.z);
  });
}

/// Writes the lines where there are any.
void write_lines(const Tin& tin, const std::vector<std::string>& theme_names, BufferedFile& file, StepProgress& steps) {
  if (tin.lines.empty()) return;
  write_array(file, "lines", tin.lines.size(), steps, [&](std::uint32_t i) {
    const LineEdge& e = tin.lines[i];
    const nlohmann::ordered_json theme = e.theme <= theme_names.size() ? theme_names[e.theme - std::size_t{1}] : "";
    file.print("[{},{},{}]", e.from, e.to, dumped(theme));
  });
}

void write_triangle_based(const Tin& tin, BufferedFile& file, StepProgress& steps) {
  write_array(file, "triangles", tin.triangles.size(), steps, [&](std::uint32_t t) {
    const auto [a, b, c] = tin.triangles[t];
    file.print("[{},{},{}]", a, b, c);
  });
  const auto adjacent = adjacent_triangles(tin);
  write_array(file, "adjacent_triangles", adjacent.size(), steps, [&](std::uint32_t t) {
    const auto text = [&](std::size_t i) {
      return index_or_null(adjacent[t][i] == kNoNeighbour ? std::nullopt : std::optional(adjacent[t][i]));
    };
    file.print("[{},{},{}]", text(0), text(1), text(2));
  });
}

void write_vertex_based(const Topology& topology, BufferedFile& file, StepProgress& steps) {
  write_array(file, "neighbours", topology.vertex_count(), steps,
              [&](std::uint32_t v) { file.print("[{}]", fmt::join(topology.vertices_of_vertex(v), ",")); });
  write_array(file, "boundary", topology.vertex_count(), steps,
              [&](std::uint32_t v) { file.print("{}", topology.on_boundary(v)); });
}

void write_edge_based(const Topology& topology, BufferedFile& file, StepProgress& steps) {
  write_array(file, "half_edges", topology.half_edge_count(), steps, [&](std::uint32_t h) {
    file.print("[{},{},{},{}]", topology.origin(h), index_or_null(topology.twin(h)), Topology::next(h),
               Topology::face(h));
  });
}

const char* name_of(TopologyKind kind) {
  switch (kind) {
    case TopologyKind::TriangleBased:
      return "triangle";
    case TopologyKind::VertexBased:
      return "vertex";
    case TopologyKind::EdgeBased:
      return "edge";
  }
  return "";
}

}  // namespace

void write_topology_json(const Tin& tin, TopologyKind kind, const PendingFile& output, const TinExportOptions& options,
                         Progress& progress) {
  nlohmann::ordered_json head = parsed_metadata(options.metadata_json);
  head["topology"] = name_of(kind);
  head["crs"] = options.crs_wkt;
  BufferedFile file(output);
  std::string opening = dumped(head);
  opening.pop_back();  // the closing brace comes last
  file.write(opening);
  StepProgress steps(progress, 5 * tin.vertices.size() + 3 * tin.triangles.size());
  write_vertices(tin, file, steps);
  write_lines(tin, options.theme_names, file, steps);
  switch (kind) {
    case TopologyKind::TriangleBased:
      write_triangle_based(tin, file, steps);
      break;
    case TopologyKind::VertexBased:
      write_vertex_based(Topology(tin), file, steps);
      break;
    case TopologyKind::EdgeBased:
      write_edge_based(Topology(tin), file, steps);
      break;
  }
  file.write("}\n");
  file.close();
}

}  // namespace itin
