#include "store/info_document.hpp"

#include <optional>

#include <itin/coordinates.hpp>
#include <itin/height_axis.hpp>
#include <itin/store_scale.hpp>

#include "output/store_document.hpp"

namespace itin::cli {

namespace {

Document heights_document(const std::optional<HeightAxis>& heights) {
  if (!heights) return nullptr;
  return {{"datum", heights->datum.empty() ? Document(nullptr) : Document(heights->datum)},
          {"unit", heights->unit},
          {"unit_m", heights->metres},
          {"direction", heights->down ? "down" : "up"}};
}

Document sources_document(const StoreMetadata& metadata, const StatedHeights& heights) {
  Document sources = Document::array();
  for (const SourceInfo& source : metadata.sources) {
    sources.push_back({{"path", source.path},
                       {"kind", source.kind},
                       {"theme", source.theme},
                       {"imported", source.imported},
                       {"sha256", source.sha256},
                       {"crs", source.source_crs},
                       {"heights", heights_document(heights.of(source))},
                       {"vertices", source.vertices},
                       {"spacing_m", source.spacing},
                       {"replaces", source.replaces},
                       {"makes_room", source.makes_room},
                       {"note", source.note.empty() ? Document(nullptr) : Document(source.note)}});
  }
  return sources;
}

Document scale_document(const std::optional<GridScale>& scale) {
  return scale ? Document{{"least", scale->least}, {"greatest", scale->greatest}} : Document(nullptr);
}

}  // namespace

double bytes_per_vertex(const Store& store) {
  const std::uint64_t vertices = store.metadata().vertices;
  return vertices == 0 ? 0 : static_cast<double>(store.file_bytes()) / static_cast<double>(vertices);
}

Document info_document(const Store& store, const StatedHeights& heights) {
  const StoreMetadata& metadata = store.metadata();
  Document document;
  document["crs"] = crs_identifier(metadata.crs_wkt);
  document["crs_name"] = crs_title(metadata.crs_wkt);
  document["format_version"] = metadata.format_version;
  document["bounds"] = box_document(metadata.grid.box(metadata.bounds));
  document["resolution_m"] = metadata.grid.resolution;
  document["scale"] = scale_document(scale_of(metadata));
  document["vertices"] = metadata.vertices;
  document["bytes"] = store.file_bytes();
  document["bytes_per_vertex"] = bytes_per_vertex(store);
  document["levels"] = levels_document(metadata);
  document["themes"] = themes_document(metadata);
  document["sources"] = sources_document(metadata, heights);
  return document;
}

}  // namespace itin::cli
