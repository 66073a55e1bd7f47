// itin info: what a store holds.

#include <optional>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/height_axis.hpp>
#include <itin/stated_heights.hpp>
#include <itin/store.hpp>
#include <itin/store_scale.hpp>

#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/verb.hpp"

namespace itin::cli {

namespace {

double bytes_per_vertex(const Store& store) {
  const std::uint64_t vertices = store.metadata().vertices;
  return vertices == 0 ? 0 : static_cast<double>(store.file_bytes()) / static_cast<double>(vertices);
}

Document heights_document(const std::optional<HeightAxis>& heights) {
  if (!heights) return nullptr;
  return {{"datum", heights->datum.empty() ? Document(nullptr) : Document(heights->datum)},
          {"unit", heights->unit},
          {"unit_m", heights->metres},
          {"direction", heights->down ? "down" : "up"}};
}

/// Whether lines with heights stay where finer ground takes the place of other ground.
bool stays(const SourceInfo& source) {
  return !source.theme.empty() && is_terrain(theme_kind(source.kind)) && !source.makes_room;
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

std::string info_text(const Store& store, const StatedHeights& heights) {
  const StoreMetadata& metadata = store.metadata();
  const Box bounds = metadata.grid.box(metadata.bounds);
  std::string text =
      fmt::format("{:<12}{} ({})\n", "CRS", crs_title(metadata.crs_wkt), crs_identifier(metadata.crs_wkt));
  text += fmt::format("{:<12}{:.2f},{:.2f} to {:.2f},{:.2f} ({:.1f} x {:.1f} km)\n", "bounds", bounds.xmin, bounds.ymin,
                      bounds.xmax, bounds.ymax, bounds.width() / 1000, bounds.height() / 1000);
  text += fmt::format("{:<12}{:g} m\n", "resolution", metadata.grid.resolution);
  if (const auto scale = scale_of(metadata))
    text += fmt::format("{:<12}{:.5f} to {:.5f} (grid distance / geodesic distance)\n", "scale", scale->least,
                        scale->greatest);
  text += fmt::format("{:<12}{} in {}, {:.2f} bytes per vertex\n", "vertices", grouped(metadata.vertices),
                      readable_bytes(store.file_bytes()), bytes_per_vertex(store));
  text += themes_table(metadata) + "\n";
  text += levels_table(metadata);
  text += "\nimported\n";
  for (const SourceInfo& source : metadata.sources) {
    const std::string spacing = !source.theme.empty() ? fmt::format("in theme {}", source.theme)
                                : source.spacing > 0  ? fmt::format("every {:.4g} m", source.spacing)
                                                      : "by need";
    text += fmt::format("  {}  {}{}  {:>13} vertices, {}  {}\n", source.imported, source.kind,
                        source.replaces ? " (replacing)"
                        : stays(source) ? " (staying)"
                                        : "",
                        grouped(source.vertices), spacing, source.path);
    if (const std::string of = heights.text_of(source); !of.empty()) text += fmt::format("{:22}  {}\n", "", of);
    if (!source.note.empty()) text += fmt::format("{:22}  {}\n", "", source.note);
  }
  return text;
}

class InfoVerb final : public Verb {
 public:
  std::string name() const override { return "info"; }
  std::string summary() const override { return "Show what a store holds"; }
  void declare(CLI::App& app) override { reads(app.add_option("STORE", store_, "The store")->required()); }
  void validate() override {}
  Document parameters() const override { return {{"store", store_}}; }
  Result execute(Progress&) override {
    const Store store(store_);
    const StatedHeights heights(store.metadata());
    Result result{info_document(store, heights), info_text(store, heights), {}, {}};
    warn_of_grid(store.metadata(), result.warnings);
    return result;
  }

 private:
  std::string store_;
};

}  // namespace

std::unique_ptr<Verb> make_info_verb() {
  return std::make_unique<InfoVerb>();
}

}  // namespace itin::cli
