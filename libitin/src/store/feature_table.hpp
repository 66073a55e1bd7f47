// What sources say about a theme's features: ids, names and attributes. See libitin/FORMAT.md, "Feature block".
//
//   FeatureTable table(store, theme);
//   if (const FeatureRecord* record = table.at(number)) std::cout << record->id << ' ' << record->name << '\n';
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <itin/store.hpp>

namespace itin {

/// A value of a field; nothing where a feature has none.
using AttributeValue = std::variant<std::monostate, double, std::int64_t, std::string>;

struct FeatureRecord {
  std::string id;                      ///< the id field's value, or the source's number for the feature
  std::string name;                    ///< the name field's value; empty without one
  std::vector<AttributeValue> values;  ///< by the theme's fields; fields beyond the end have no value
  friend bool operator==(const FeatureRecord&, const FeatureRecord&) = default;
};

/// The fields of a theme's features, and a record of each feature; empty records at the end may be missing.
struct ThemeFeatures {
  std::vector<AttributeField> fields;
  std::vector<FeatureRecord> records;
};

inline constexpr std::size_t kFeaturesInBlock = 256;
/// The most fields in a theme, and the most bytes in a text.
inline constexpr std::size_t kMostAttributes = 255, kLongestText = 4096;

/// Reads the records of one theme on demand, and keeps the blocks that they came in.
class FeatureTable {
 public:
  /// Takes the theme's number, from 1. The store must outlive the table.
  FeatureTable(const Store& store, std::uint16_t theme) : store_(store), theme_(theme) {}
  /// Returns the record of the feature with this number, from 0; null where the store has no
  /// such record. Throws CorruptStore.
  const FeatureRecord* at(std::int64_t number);

 private:
  const Store& store_;
  std::uint16_t theme_;
  std::map<std::uint32_t, std::vector<FeatureRecord>> blocks_;
};

/// Returns all fields and records of a theme. Throws CorruptStore.
ThemeFeatures stored_features(const Store& store, std::uint16_t theme);

std::vector<std::uint8_t> encode_features(std::span<const FeatureRecord> records);
/// Decodes a block of features. Throws DecodeError, also for a record of more than `fields` values.
std::vector<FeatureRecord> decode_features(std::span<const std::uint8_t> bytes, std::size_t fields);

}  // namespace itin
