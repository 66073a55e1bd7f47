// The ids, names and attributes that an import keeps of the buildings of a CityJSON document. A part of a building has
// those of the building, too.
//
//   CityJsonAttributes attributes(path, query);
//   for (const auto& object : buildings) attributes.note(object);
//   attributes.finish(objects);
//   records.push_back(attributes.record(key));
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "import/source/layers/kept_features.hpp"

namespace itin {

/// Buildings and parts of buildings by their keys.
using CityObjects = std::map<std::string, const nlohmann::json*>;

class CityJsonAttributes {
 public:
  CityJsonAttributes(std::string path, FeatureQuery query);

  /// Learns what attributes a building or a part of one has. Throws BadCityJson.
  void note(const nlohmann::json& building);
  /// Chooses the fields; by default, these are all that hold numbers, texts and truth values, by name. The objects must
  /// outlive this, and must have been noted. Throws FileError for an attribute that no
  /// building has, InputError for one that holds lists or objects, and for too many.
  void finish(const CityObjects& objects);
  const std::vector<AttributeField>& fields() const { return fields_; }

  /// Returns what is kept of the object with this key, which is its id unless another was asked for. Truth values are 0
  /// and 1. Throws InputError, naming object and attribute, for a text that is too long in an attribute that was asked
  /// for.
  FeatureRecord record(const std::string& key);
  /// Tells what was not kept, though all was asked for, in one line each.
  std::vector<std::string> warnings() const;

 private:
  /// Throws as finish() does.
  AttributeType type_of(const std::string& name) const;
  const nlohmann::json* attribute(const std::string& key, const std::string& name) const;
  std::string text(const std::string& key, const std::string& name) const;
  AttributeValue value(const std::string& key, const AttributeField& field);

  std::string path_;
  FeatureQuery query_;
  KeptTexts texts_;
  std::map<std::string, std::optional<AttributeType>> types_;  ///< no type where any value is a list or an object
  const CityObjects* objects_ = nullptr;
  std::vector<AttributeField> fields_;
  std::vector<std::string> left_out_;  ///< names
};

}  // namespace itin
