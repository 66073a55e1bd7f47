#include <algorithm>
#include <array>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/tin_export.hpp>

#include "export/tin/tin_formats.hpp"

namespace itin {

namespace {

using Writer = void (*)(const Tin&, const PendingFile&, const TinExportOptions&, Progress&);

struct Format {
  std::string_view ending;
  Writer write;
};

constexpr std::array<Format, 6> kFormats{{{".ply", write_ply},
                                          {".obj", write_obj},
                                          {".glb", write_glb},
                                          {".gpkg", write_geopackage},
                                          {".geojson", write_geojson},
                                          {".2dm", write_2dm}}};

Writer writer_for(const std::string& path) {
  const std::string ending = ending_of(path);
  const auto* format =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const Format& f) { return f.ending == ending; });
  if (format == kFormats.end())
    throw InputError(
        fmt::format("{}: a triangulation is not written as '{}'; end the name in .ply, .obj, .glb, .gpkg, "
                    ".geojson or .2dm",
                    path, ending));
  return format->write;
}

void require_json(const std::string& path) {
  if (ending_of(path) != ".json")
    throw InputError(fmt::format("{}: topology is written as JSON; end the name in .json", path));
}

}  // namespace

TopologyKind topology_kind(std::string_view name) {
  if (name == "triangle") return TopologyKind::TriangleBased;
  if (name == "vertex") return TopologyKind::VertexBased;
  if (name == "edge") return TopologyKind::EdgeBased;
  throw InputError(fmt::format("topology: '{}' is none of triangle, vertex and edge", name), "topology");
}

void require_tin_output(const std::string& path, bool overwrite) {
  writer_for(path);
  PendingFile::require_possible(path, overwrite);
}

void require_topology_output(const std::string& path, bool overwrite) {
  require_json(path);
  PendingFile::require_possible(path, overwrite);
}

void export_tin(const Tin& tin, const std::string& path, const TinExportOptions& options, Progress& progress) {
  const Writer write = writer_for(path);
  PendingFile output(path, options.overwrite);
  CallProgress call(progress);
  write(tin, output, options, call);
  output.commit();
  call.finish();
}

void export_topology(const Tin& tin, TopologyKind kind, const std::string& path, const TinExportOptions& options,
                     Progress& progress) {
  require_json(path);
  PendingFile output(path, options.overwrite);
  CallProgress call(progress);
  write_topology_json(tin, kind, output, options, call);
  output.commit();
  call.finish();
}

}  // namespace itin
