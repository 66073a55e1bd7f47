// StoreMetadata as the JSON text in the store.
#pragma once

#include <string>

#include <itin/store.hpp>

namespace itin {

std::string metadata_to_json(const StoreMetadata& metadata);
/// Reads metadata. Throws DecodeError where the text is not such a document.
StoreMetadata metadata_from_json(const std::string& text);

}  // namespace itin
