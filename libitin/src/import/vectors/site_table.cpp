#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/site_table.hpp>

#include "gdal/quiet_gdal.hpp"
#include "import/source/source_layer.hpp"
#include "import/vectors/place_file.hpp"

namespace itin {

namespace {

/// Finds a field; negative if there is none. Shapefiles cut names to ten letters.
int field_named(OGRLayer& layer, const std::string& name) {
  constexpr std::size_t kOfShapefile = 10;
  const int whole = layer.GetLayerDefn()->GetFieldIndex(name.c_str());
  return whole >= 0 ? whole : layer.GetLayerDefn()->GetFieldIndex(name.substr(0, kOfShapefile).c_str());
}

class TableRows {
 public:
  TableRows(GDALDataset& file, OGRLayer& layer, const SiteQuery& query, const std::vector<SiteField>& fields,
            const std::string& to_crs)
      : places_(file, layer, query, to_crs) {
    for (const SiteField& field : fields) {
      const int there = field_named(layer, field.name);
      fields_.push_back(there < 0 && field.required ? field_of_layer(layer, query.path, field.name) : there);
    }
  }

  SiteRow read(const OGRFeature& feature) const {
    SiteRow row;
    row.feature = feature.GetFID();
    for (const int field : fields_) {
      const bool present =
          field >= 0 && feature.IsFieldSetAndNotNull(field) && *feature.GetFieldAsString(field) != '\0';
      row.values.push_back(present ? std::optional<std::string>(feature.GetFieldAsString(field)) : std::nullopt);
    }
    Point2 place;
    row.error = places_.find(feature, place);
    if (row.error.empty()) row.position = place;
    return row;
  }

 private:
  Places places_;
  std::vector<int> fields_;
};

}  // namespace

std::vector<SiteRow> read_site_rows(const SiteQuery& query, const std::vector<SiteField>& fields,
                                    const std::string& to_crs) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_place_file(query.path, ColumnTypes::kTexts);
  OGRLayer& layer = choose_layer(*dataset, query.path, query.layer);
  select_features(layer, query.path, query.where);
  const TableRows reader(*dataset, layer, query, fields, to_crs);
  std::vector<SiteRow> rows;
  while (const OGRFeatureUniquePtr feature = next_feature(layer, query.path)) rows.push_back(reader.read(*feature));
  return rows;
}

}  // namespace itin
