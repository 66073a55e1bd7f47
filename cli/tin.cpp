// itin tin: the triangulation of a window.

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/store.hpp>
#include <itin/tin_export.hpp>
#include <itin/triangulate.hpp>

#include "detail_options.hpp"
#include "output_path.hpp"
#include "store_document.hpp"
#include "surface_options.hpp"
#include "verb.hpp"
#include "window_options.hpp"

namespace itin::cli {

namespace {

class TinVerb final : public Verb {
 public:
  std::string name() const override { return "tin"; }
  std::string summary() const override { return "Write the triangulation of a window"; }

  void declare(CLI::App& app) override {
    app.add_option("STORE", store_, "The store")->required();
    window_.declare(app);
    app.add_option("-o,--output", output_, "What to write: .ply, .obj, .glb, .gpkg or .geojson; a topology: .json")
        ->type_name("FILE")
        ->required();
    app.add_option("--topology", topology_, "Write this structure of the triangulation: triangle, vertex or edge")
        ->type_name("KIND");
    detail_.declare(app);
    themes_.declare(app);
    policy_.declare(app);
  }

  void validate() override {
    window_.validate();
    detail_.validate();
    themes_.validate();
    if (!topology_.empty()) kind_ = topology_kind(topology_);
  }

  Document parameters() const override {
    Document parameters{{"store", store_}, {"output", output_}};
    parameters.update(query());
    return parameters;
  }

  Result execute(Progress& progress) override {
    if (kind_) {
      require_topology_output(output_, policy_.overwrite);
    } else {
      require_tin_output(output_, policy_.overwrite);
    }
    const Store store(store_);
    const auto [window, centre] = window_.region(store.metadata());
    const Detail detail = detail_.detail(centre);
    themes_.choice().check(store.metadata().themes);
    const Tin tin = triangulate(store, window, detail, progress, themes_.choice());
    const Document surface = surface_document(store.metadata(), detail, themes_.choice());
    write(tin, store.metadata(), surface, progress);
    return {document(tin, store.metadata(), surface), text(tin), {}, {}};
  }

 private:
  /// Without the names of files: what is written must not depend on them.
  Document query() const {
    Document query = window_.parameters();
    query.update(detail_.parameters());
    query.update(themes_.parameters());
    if (kind_) query["topology"] = topology_;
    return query;
  }

  void write(const Tin& tin, const StoreMetadata& metadata, const Document& surface, Progress& progress) const {
    TinExportOptions options;
    options.crs_wkt = metadata.crs_wkt;
    options.overwrite = policy_.overwrite;
    for (const ThemeInfo& theme : metadata.themes) options.theme_names.push_back(theme.name);
    options.metadata_json = Document{{"itin", ITIN_VERSION}, {"command", query()}, {"surface", surface}}.dump();
    if (kind_) {
      export_topology(tin, *kind_, output_, options, progress);
    } else {
      export_tin(tin, output_, options, progress);
    }
  }

  Document document(const Tin& tin, const StoreMetadata& metadata, const Document& surface) const {
    Document document;
    document["crs"] = crs_identifier(metadata.crs_wkt);
    document["surface"] = surface;
    if (!tin.vertices.empty()) document["bounds"] = box_document(tin.bounds());
    document["vertices"] = tin.vertices.size();
    document["triangles"] = tin.triangles.size();
    document["line_edges"] = tin.lines.size();
    document["outputs"] = Document::array({output_});
    document["statistics"] = {{"points_read", tin.statistics.points_read},
                              {"blocks_read", tin.statistics.blocks_read},
                              {"triangles", tin.triangles.size()}};
    return document;
  }

  std::string text(const Tin& tin) const {
    return fmt::format("{}: {} vertices, {} triangles, {}\nread {} points in {} blocks\n", output_,
                       grouped(tin.vertices.size()), grouped(tin.triangles.size()),
                       readable_bytes(std::filesystem::file_size(output_)), grouped(tin.statistics.points_read),
                       grouped(tin.statistics.blocks_read));
  }

  std::string store_, output_, topology_;
  std::optional<TopologyKind> kind_;
  WindowOptions window_;
  DetailOptions detail_;
  ThemeOptions themes_;
  OutputPolicy policy_;
};

}  // namespace

std::unique_ptr<Verb> make_tin_verb() {
  return std::make_unique<TinVerb>();
}

}  // namespace itin::cli
