#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/site_table.hpp>

#include "gdal/quiet_gdal.hpp"
#include "import/source/source_layer.hpp"
#include "import/vectors/place_file.hpp"

namespace itin {

namespace {

class RowReader {
 public:
  RowReader(GDALDataset& file, OGRLayer& layer, const SiteQuery& query, const std::vector<std::string>& fields,
            const std::string& to_crs)
      : places_(file, layer, query, to_crs) {
    for (const std::string& name : fields) fields_.push_back(layer.GetLayerDefn()->GetFieldIndex(name.c_str()));
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

std::vector<SiteRow> read_site_rows(const SiteQuery& query, const std::vector<std::string>& fields,
                                    const std::string& to_crs) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_place_file(query.path, ColumnTypes::kTexts);
  OGRLayer& layer = choose_layer(*dataset, query.path, query.layer);
  select_features(layer, query.path, query.where);
  const RowReader reader(*dataset, layer, query, fields, to_crs);
  std::vector<SiteRow> rows;
  while (const OGRFeatureUniquePtr feature = next_feature(layer, query.path)) rows.push_back(reader.read(*feature));
  return rows;
}

}  // namespace itin
