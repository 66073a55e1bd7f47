#include <itin/site_table.hpp>

#include "gdal/files/quiet_gdal.hpp"
#include "import/source/layers/source_layer.hpp"
#include "import/vectors/place_file.hpp"

namespace itin {

namespace {

class TableRows {
 public:
  TableRows(const SiteQuery& query, const std::vector<SiteField>& fields, const std::string& to_crs)
      : path_(query.path), file_(query), places_(file_, query, to_crs) {
    for (const SiteField& field : fields) {
      const int there = file_.field(field.name);
      fields_.push_back(there < 0 && field.required ? field_of_layer(file_.layer(), path_, field.name) : there);
    }
    select_features(file_.layer(), path_, query.where);
  }

  std::vector<SiteRow> read(std::vector<std::string>& warnings) {
    while (const OGRFeatureUniquePtr feature = next_feature(file_.layer(), path_)) add(*feature);
    for (const auto& lines : {file_.warnings(), places_.warnings()})
      warnings.insert(warnings.end(), lines.begin(), lines.end());
    return std::move(rows_);
  }

 private:
  void add(const OGRFeature& feature) {
    SiteRow row;
    row.feature = feature.GetFID();
    row.place = file_.place_of(feature);
    for (const int field : fields_) {
      const std::string text = file_.text(feature, field);
      row.values.push_back(text.empty() ? std::nullopt : std::optional(text));
    }
    const Places::Found found = places_.find(feature);
    row.error = found.wrong;
    if (found.positions.empty()) return rows_.push_back(row);
    for (const Point2 position : found.positions) {
      row.position = position;
      rows_.push_back(row);
    }
  }

  std::string path_;
  PlaceFile file_;
  Places places_;
  std::vector<int> fields_;
  std::vector<SiteRow> rows_;
};

}  // namespace

std::vector<SiteRow> read_site_rows(const SiteQuery& query, const std::vector<SiteField>& fields,
                                    const std::string& to_crs, std::vector<std::string>& warnings) {
  const QuietGdal quiet;
  return TableRows(query, fields, to_crs).read(warnings);
}

}  // namespace itin
