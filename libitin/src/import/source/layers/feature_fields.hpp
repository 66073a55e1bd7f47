// The ids, names and attributes that an import keeps of a layer's features.
//
//   FeatureFields kept(layer, path, query);
//   if (kept.any()) records.push_back(kept.record(feature));
#pragma once

#include <string>
#include <vector>

#include <itin/plain_text.hpp>

#include "import/source/layers/kept_features.hpp"

class OGRFeature;
class OGRLayer;

namespace itin {

class FeatureFields {
 public:
  /// By default, these are all fields of numbers, texts, dates and times, and features have the layer's own numbers as
  /// ids. Throws FileError for a field that the layer has not, InputError for one of lists or bytes, and for too many.
  FeatureFields(OGRLayer& layer, std::string path, FeatureQuery query);

  /// Whether anything is to be kept of the features.
  bool any() const { return query_.any(); }
  const std::vector<AttributeField>& fields() const { return fields_; }
  /// Returns what is kept of a feature. Throws InputError, naming feature and field, for a text that is too long in a
  /// field that was asked for.
  FeatureRecord record(const OGRFeature& feature);
  /// Tells what was not kept of the records so far, though all was asked for, in one line each.
  std::vector<std::string> warnings() const;

 private:
  void add(OGRLayer& layer, int index);
  std::string text(const OGRFeature& feature, int index);
  AttributeValue value(const OGRFeature& feature, std::size_t field);

  std::string path_;
  FeatureQuery query_;
  KeptTexts texts_;
  PlainTexts plain_;
  int id_ = -1, name_ = -1;
  std::vector<AttributeField> fields_;
  std::vector<int> indices_;  ///< the index of each of fields_ in the layer
  std::vector<std::string> warnings_;
};

}  // namespace itin
