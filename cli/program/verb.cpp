#include "program/verb.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <viewshed/tasks.hpp>

#include "program/field_names.hpp"

namespace itin::cli {

std::unique_ptr<viewshed::Tasks> Verb::divide(std::uint64_t, Progress&) {
  throw InputError(
      fmt::format("itin job divides site, viewshed, visibility and ztv, not {}; run it by itself", name()));
}

void Verb::take_answers(viewshed::Tasks&) {
  throw std::logic_error(name() + " cannot be divided");
}

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
