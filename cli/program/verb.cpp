#include "program/verb.hpp"

#include <algorithm>

#include "program/field_names.hpp"

namespace itin::cli {

Document call_document(const Verb& verb) {
  Document document{{"itin", ITIN_VERSION}, {"command", {{"verb", verb.name()}}}};
  document["command"].update(verb.parameters());
  return document;
}

std::string folder_document(const Verb& verb, Result& result) {
  std::transform(result.warnings.begin(), result.warnings.end(), result.warnings.begin(), in_options);
  Document document = call_document(verb);
  document.update(result.document);
  document["warnings"] = result.warnings;
  document.erase("statistics");
  return json_text(document, 2) + "\n";
}

}  // namespace itin::cli
