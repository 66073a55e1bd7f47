#include <cmath>

#include <itin/document.hpp>
#include <itin/level_choice.hpp>

namespace itin {

std::string json_text(const Document& document, int indent) {
  return document.dump(indent, ' ', false, Document::error_handler_t::replace);
}

std::string result_text(const Document& document) {
  Document result{{"itin", ITIN_VERSION}};
  result.update(document);
  return json_text(result, 2) + "\n";
}

Document number_or_null(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? Document(*number) : Document(nullptr);
}

Document error_interval(const CertifiedError& error) {
  return Document::array({error.lo, error.hi});
}

Document surface_document(const StoreMetadata& metadata, const Detail& detail, const ThemeChoice& themes) {
  Document surface{{"tolerance_m", detail.coarsest()},
                   {"certified_error_m", error_interval(certified_error(metadata, detail))}};
  if (detail.rings().size() > 1) {
    surface["centre"] = {{"x", detail.centre().x}, {"y", detail.centre().y}};
    for (const Ring& ring : detail.rings()) {
      surface["rings"].push_back({{"radius_m", ring.radius}, {"tolerance_m", ring.tolerance}});
    }
  }
  surface["themes"] = themes.names(metadata.themes);
  for (const OmittedFeature& f : themes.omitted())
    surface["without"].push_back({{"theme", f.theme_name},
                                  {"feature", f.name},
                                  {"feature_number", f.number},
                                  {"feature_id", f.id.empty() ? Document(nullptr) : Document(f.id)}});
  return surface;
}

Document statistics_document(const RetrievalStatistics& read, std::uint64_t triangles) {
  return {{"points_read", read.points_read}, {"blocks_read", read.blocks_read}, {"triangles", triangles}};
}

Document earth_document(const Earth& earth) {
  Document document{{"convention", earth.convention()}, {"curvature", earth.curvature}};
  if (earth.effective_factor) {
    document["effective_earth"] = *earth.effective_factor;
  } else {
    document["k"] = earth.refraction;
  }
  document["earth_radius_m"] = earth.radius;
  return document;
}

Document box_document(const Box& box) {
  return {{"xmin", box.xmin}, {"ymin", box.ymin}, {"xmax", box.xmax}, {"ymax", box.ymax}};
}

Document sources_document(const std::vector<SourceInfo>& sources) {
  Document list = Document::array();
  for (const SourceInfo& source : sources) {
    list.push_back({{"path", source.path},
                    {"kind", source.kind},
                    {"sha256", source.sha256},
                    {"spacing_m", source.spacing},
                    {"note", source.note.empty() ? Document(nullptr) : Document(source.note)}});
  }
  return list;
}

}  // namespace itin
