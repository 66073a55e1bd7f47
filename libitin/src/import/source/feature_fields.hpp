// What an import keeps of a layer's features besides their geometry: ids, names and attributes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/import.hpp>

#include "store/feature_table.hpp"

class OGRFeature;
class OGRLayer;

namespace itin {

struct FeatureQuery {
  std::string id_field;                                ///< default: the source's number for the feature
  std::string name_field;                              ///< default: features have no names
  std::optional<std::vector<std::string>> attributes;  ///< default: all fields of numbers, texts, dates and times
};
FeatureQuery feature_query(const ImportOptions& options);

class FeatureFields {
 public:
  /// Throws FileError for a field that the layer has not, InputError for one of lists or bytes, and for too many.
  FeatureFields(OGRLayer& layer, std::string path, const FeatureQuery& query);

  /// Whether anything is to be kept of the features.
  bool any() const { return keeps_; }
  const std::vector<AttributeField>& fields() const { return fields_; }
  /// Throws InputError, naming feature and field, for a text that is too long.
  FeatureRecord record(const OGRFeature& feature) const;

 private:
  void add(OGRLayer& layer, int index, bool by_name);
  std::string text(const OGRFeature& feature, int index) const;
  AttributeValue value(const OGRFeature& feature, std::size_t field) const;

  std::string path_;
  int id_ = -1, name_ = -1;
  bool keeps_ = false;
  std::vector<AttributeField> fields_;
  std::vector<int> indices_;  ///< of them in the layer
};

/// Finds the fields of a source among those of a theme, to which it adds those that it has not. A field that holds
/// whole numbers in one source and others in another holds numbers, and one that holds texts in either holds texts.
/// Gives the place of each. Throws InputError, naming the source, where they become too many.
std::vector<std::size_t> places_among(std::vector<AttributeField>& theme, const std::vector<AttributeField>& source,
                                      const std::string& path);
/// The record with its values at these places.
FeatureRecord arranged(FeatureRecord record, const std::vector<std::size_t>& places);

}  // namespace itin
