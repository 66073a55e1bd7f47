// What an import keeps of features besides their geometry, whatever file they come from: ids, names and attributes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/import.hpp>

#include "store/feature_table.hpp"

namespace itin {

struct FeatureQuery {
  std::string id_field = {};                                ///< default: what the source itself calls the feature
  std::string name_field = {};                              ///< default: features have no names
  std::optional<std::vector<std::string>> attributes = {};  ///< default: all that a store can keep

  /// Whether anything is to be kept.
  bool any() const { return !attributes || !attributes->empty() || !id_field.empty() || !name_field.empty(); }
};
/// Reads the query from the options. Throws InputError for an attribute that comes twice.
FeatureQuery feature_query(const ImportOptions& options);

/// The type that holds the values of both types.
AttributeType wider(AttributeType a, AttributeType b);

/// Throws InputError, naming the source, where a theme would have more fields than allowed.
void require_few_fields(std::size_t fields, const std::string& path);

/// Texts of a source, none of them longer than a store keeps.
class KeptTexts {
 public:
  explicit KeptTexts(std::string path) : path_(std::move(path)) {}
  /// Throws InputError, naming feature and field, for a text that is too long.
  std::string required(std::string text, const std::string& feature, const std::string& field) const;
  /// Returns the text; nothing in place of one that is too long, of which warnings() tells.
  AttributeValue if_short(std::string text, const std::string& feature, const std::string& field);
  /// Returns one line, or none.
  std::vector<std::string> warnings() const;

 private:
  std::string path_, first_;
  std::uint64_t left_out_ = 0;
};

/// Finds the fields of a source among those of a theme, and adds missing ones to the theme. A field that holds whole
/// numbers in one source and others in another holds numbers; one that holds texts in either holds texts. Returns the
/// place of each field. Throws InputError, naming the source, where they become too many. Precondition: the names of a
/// source's fields differ.
std::vector<std::size_t> places_among(std::vector<AttributeField>& theme, const std::vector<AttributeField>& source,
                                      const std::string& path);
/// Returns the record with its values at these places.
FeatureRecord arranged(FeatureRecord record, const std::vector<std::size_t>& places);

}  // namespace itin
