// Reads options of `itin site` from a parameter file, and collects them for one.

#include <fstream>

#include <fmt/format.h>

#include <itin/document.hpp>
#include <itin/error.hpp>

#include "site/site_options.hpp"

namespace itin::cli {

namespace {

std::string text_of(const std::string& key, const Document& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number()) return json_text(value);
  if (value.is_array()) {
    std::string list;
    for (const Document& item : value) list += (list.empty() ? "" : ",") + text_of(key, item);
    return list;
  }
  throw InputError(fmt::format("--params: '{}' holds no text, number or list of them", key));
}

/// Tells whether an option belongs to the run itself, and does not only say where and how the run is written.
bool is_parameter(const std::string& name) {
  for (const char* other :
       {"help", "params", "output", "json", "quiet", "progress", "uploads", "threads", "allow-network", "resume",
        "overwrite", "memory", "engine", "sheets", "sheet-scale", "basemap", "project", "date"})
    if (name == other) return false;
  return true;
}

}  // namespace

void SiteOptions::apply_parameter_file() {
  if (params_.empty()) return;
  std::ifstream file(params_);
  if (!file) throw FileError(params_, "cannot be read");
  const Document parameters = Document::parse(file, nullptr, false);
  if (!parameters.is_object()) throw InputError(params_ + ": is no JSON object of options");
  for (const auto& [key, value] : parameters.items()) {
    if (key == "store" || key == "inputs" || key == "itin") continue;  // echoed by runs; the call names the store
    CLI::Option* option = app_->get_option_no_throw("--" + key);
    if (option == nullptr || !is_parameter(key)) throw InputError(fmt::format("{}: no option '{}'", params_, key));
    if (option->count() > 0) continue;
    const std::string text = text_of(key, value);
    try {
      option->add_result(text);
      option->run_callback();
    } catch (const CLI::ParseError&) {
      throw InputError(fmt::format("{}: '{}' is no value of the option '{}'", params_, text, key));
    }
  }
}

Document SiteOptions::given() const {
  Document result = Document::object();
  for (const CLI::Option* option : app_->get_options()) {
    const std::string name = option->get_single_name();
    if (option->count() == 0 || name == "STORE" || !is_parameter(name)) continue;
    if (option->get_type_size() == 0) {
      result[name] = true;
    } else {
      result[name] = option->results().back();
    }
  }
  return result;
}

}  // namespace itin::cli
