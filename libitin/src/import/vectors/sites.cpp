#include <cmath>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>
#include <itin/height_limit.hpp>
#include <itin/position_columns.hpp>
#include <itin/sites.hpp>

#include "gdal/files/quiet_gdal.hpp"
#include "import/source/layers/source_layer.hpp"
#include "import/vectors/place_file.hpp"

namespace itin {

namespace {

/// The index of a field; -1 if none is asked for.
int field_index(PlaceFile& file, const std::string& path, const std::string& name) {
  if (name.empty()) return -1;
  const int index = file.field(name);
  return index < 0 ? field_of_layer(file.layer(), path, name) : index;
}

/// Reads the features of a layer as sites.
class SiteReader {
 public:
  SiteReader(const SiteQuery& query, const std::string& to_crs)
      : path_(query.path),
        file_(query),
        height_(field_index(file_, query.path, query.height_field)),
        name_(field_index(file_, query.path, query.name_field)),
        places_(file_, query, to_crs) {
    for (const NumberField& field : query.numbers)
      numbers_.push_back(field.required ? field_index(file_, path_, field.name) : file_.field(field.name));
    for (const std::string& field : query.texts) texts_.push_back(file_.field(field));
    select_features(file_.layer(), path_, query.where);
  }

  /// Reads sites. If `rejected` is null, the first feature that is not understood ends the reading.
  std::vector<Site> read(std::vector<std::string>* rejected, std::vector<std::string>& warnings) {
    for (std::int64_t row = 0; const OGRFeatureUniquePtr feature = next_feature(file_.layer(), path_); ++row) {
      try {
        add(*feature, row);
      } catch (const Error& error) {
        if (rejected == nullptr) throw;
        rejected->push_back(error.what());
      }
    }
    for (const auto& lines : {file_.warnings(), places_.warnings()})
      warnings.insert(warnings.end(), lines.begin(), lines.end());
    return std::move(sites_);
  }

 private:
  void add(const OGRFeature& feature, std::int64_t row) {
    Site site;
    site.feature = feature.GetFID();
    site.row = row;
    site.place = file_.place_of(feature);
    const std::string where = fmt::format("{}: {}", path_, site.place);
    site.name = name_ < 0 ? std::to_string(site.feature) : file_.text(feature, name_);
    const Places::Found found = places_.find(feature);
    if (!found.wrong.empty()) throw FileError(where, found.wrong);
    site.height = height_of(feature, where);
    site.numbers = numbers_of(feature, where);
    for (const int field : texts_) site.texts.push_back(field < 0 ? "" : file_.text(feature, field));
    const std::string name = site.name;
    for (std::size_t i = 0; i < found.positions.size(); ++i) {
      if (found.positions.size() > 1) site.name = fmt::format("{} ({})", name, i + 1);
      site.position = found.positions[i];
      sites_.push_back(site);
    }
  }

  std::optional<double> height_of(const OGRFeature& feature, const std::string& where) {
    const std::optional<double> height = file_.number(feature, height_);
    if (!height) return std::nullopt;
    const char* const name = feature.GetFieldDefnRef(height_)->GetNameRef();
    if (!std::isfinite(*height)) throw FileError(where, fmt::format("its height field '{}' holds no number", name));
    require_height(*height, fmt::format("{}: field '{}'", where, name));
    return height;
  }

  std::vector<std::optional<double>> numbers_of(const OGRFeature& feature, const std::string& where) {
    std::vector<std::optional<double>> numbers;
    for (const int field : numbers_) {
      numbers.push_back(file_.number(feature, field));
      if (numbers.back() && !std::isfinite(*numbers.back()))
        throw FileError(where,
                        fmt::format("its field '{}' holds no number", feature.GetFieldDefnRef(field)->GetNameRef()));
    }
    return numbers;
  }

  std::string path_;
  PlaceFile file_;
  int height_, name_;
  std::vector<int> numbers_, texts_;
  Places places_;
  std::vector<Site> sites_;
};

}  // namespace

LayerFields::LayerFields(const SiteQuery& query) {
  const QuietGdal quiet;
  PlaceFile file(query);
  names_ = field_names(file.layer());
}

std::optional<std::string> LayerFields::named(const std::string& name) const {
  const auto index = column_named(names_, name);
  if (!index) return std::nullopt;
  return EQUAL(names_[*index].c_str(), name.c_str()) ? name : names_[*index];
}

std::vector<Site> read_sites(const SiteQuery& query, const std::string& to_crs, std::vector<std::string>& warnings) {
  const QuietGdal quiet;
  return SiteReader(query, to_crs).read(nullptr, warnings);
}

std::vector<Site> read_sites(const SiteQuery& query, const std::string& to_crs, std::vector<std::string>& warnings,
                             std::vector<std::string>& rejected) {
  const QuietGdal quiet;
  return SiteReader(query, to_crs).read(&rejected, warnings);
}

}  // namespace itin
