// itin info: what a store holds.

#include <optional>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/crs_words.hpp>
#include <itin/stated_heights.hpp>
#include <itin/store.hpp>
#include <itin/store_scale.hpp>

#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/verb.hpp"
#include "store/info_document.hpp"

namespace itin::cli {

namespace {

/// Whether lines with heights stay where finer ground takes the place of other ground.
bool stays(const SourceInfo& source) {
  return !source.theme.empty() && is_terrain(theme_kind(source.kind)) && !source.makes_room;
}

std::string info_text(const Store& store, const StatedHeights& heights) {
  const StoreMetadata& metadata = store.metadata();
  const Box bounds = metadata.grid.box(metadata.bounds);
  std::string text = fmt::format("{:<12}{}\n", "CRS", crs_in_full(metadata.crs_wkt));
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
                                : source.spacing > 0  ? fmt::format("every {} m", significant(source.spacing, 4))
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
  void declare(CLI::App& app) override {
    reads(app.add_option("STORE", store_, "The store")->required());
    app.add_flag("--digest", digest_,
                 "Read the whole store and tell the digest of its content: equal stores have equal digests, whenever "
                 "and wherever they were imported");
  }
  void validate() override {}
  Document parameters() const override { return {{"store", store_}, {"digest", digest_}}; }
  Result execute(Progress& progress) override {
    const Store store(store_);
    const StatedHeights heights(store.metadata());
    Result result{info_document(store, heights), info_text(store, heights), {}, {}};
    if (digest_) {
      const std::string digest = content_digest(store, progress);
      result.document["digest"] = digest;
      result.text += fmt::format("\ndigest      {}\n", digest);
    }
    warn_of_grid(store.metadata(), result.warnings);
    return result;
  }

 private:
  std::string store_;
  bool digest_ = false;
};

}  // namespace

std::unique_ptr<Verb> make_info_verb() {
  return std::make_unique<InfoVerb>();
}

}  // namespace itin::cli
