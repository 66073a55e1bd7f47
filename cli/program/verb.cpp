#include "program/verb.hpp"

namespace itin::cli {

Document call_document(const Verb& verb) {
  Document document{{"itin", ITIN_VERSION}, {"command", {{"verb", verb.name()}}}};
  document["command"].update(verb.parameters());
  return document;
}

}  // namespace itin::cli
