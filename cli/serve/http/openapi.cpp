#include "serve/http/openapi.hpp"

#include <string>
#include <string_view>

namespace itin::cli {

namespace {

/// The paths that answer by GET with one schema each.
struct GetPath {
  const char* path;
  const char* summary;
  const char* type;
  std::initializer_list<const char*> required_options;  ///< those of the verb, where the query has its options
  bool has_more_options = true;                         ///< whether the query may have the verb's other options
};

constexpr const char* kJson = "application/json";

Document parameter(const char* in, const std::string& name, const char* type) {
  return {{"in", in}, {"name", name}, {"required", true}, {"schema", {{"type", type}}}};
}

/// The query of a verb's options, by their names without dashes.
Document options_parameter() {
  return {{"in", "query"},
          {"name", "options"},
          {"description", "Further options of the verb of this name, as `itin help` has them, without dashes"},
          {"schema", {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}}},
          {"style", "form"},
          {"explode", true}};
}

/// The names between braces in a path.
Document path_parameters(std::string_view path) {
  Document parameters = Document::array();
  for (std::size_t open = 0; (open = path.find('{', open)) != std::string_view::npos; ++open) {
    const std::string name(path.substr(open + 1, path.find('}', open) - open - 1));
    parameters.push_back(parameter("path", name, name.size() == 1 ? "integer" : "string"));
  }
  return parameters;
}

Document answer_of(const char* description, const char* type) {
  const Document schema = std::string_view(type) == kJson ? Document{{"type", "object"}} : Document::object();
  return {{"description", description}, {"content", {{type, {{"schema", schema}}}}}};
}

Document failures() {
  return {{"description", "What is wrong, in one line, and the option that is at fault"},
          {"content", {{kJson, {{"schema", {{"$ref", "#/components/schemas/Failure"}}}}}}}};
}

Document operation(const char* summary, Document parameters, Document answers) {
  answers["default"] = failures();
  Document operation{{"summary", summary}};
  if (!parameters.empty()) operation["parameters"] = std::move(parameters);
  operation["responses"] = std::move(answers);
  return operation;
}

Document get_operation(const GetPath& path) {
  Document parameters = path_parameters(path.path);
  for (const char* option : path.required_options) parameters.push_back(parameter("query", option, "string"));
  if (path.required_options.size() > 0 && path.has_more_options) parameters.push_back(options_parameter());
  return operation(path.summary, std::move(parameters), {{"200", answer_of(path.summary, path.type)}});
}

Document key_parameter() {
  return parameter("header", "X-Itin-Key", "string");
}

Document start_operation() {
  Document start =
      operation("Start a call of the program", {key_parameter()}, {{"202", answer_of("The job's id and url", kJson)}});
  start["requestBody"] = {{"required", true},
                          {"content", {{kJson, {{"schema", {{"$ref", "#/components/schemas/Job"}}}}}}}};
  return start;
}

Document upload_operation() {
  Document upload = operation("Send a file for jobs to read", {key_parameter()},
                              {{"201", answer_of("The file's name here, and the places in it", kJson)}});
  for (const char* type : {"text/csv", "application/geo+json"})
    upload["requestBody"]["content"][type]["schema"] = {{"type", "string"}, {"format", "binary"}};
  upload["requestBody"]["required"] = true;
  return upload;
}

Document delete_operation(const char* path, const char* summary) {
  Document parameters = path_parameters(path);
  parameters.push_back(key_parameter());
  return operation(summary, std::move(parameters), {{"200", answer_of("It is gone", kJson)}});
}

Document schemas() {
  const Document text{{"type", "string"}};
  return {
      {"Failure", {{"type", "object"}, {"required", {"error"}}, {"properties", {{"error", text}, {"field", text}}}}},
      {"Job",
       {{"type", "object"},
        {"required", {"verb"}},
        {"properties", {{"verb", text}, {"options", {{"type", "object"}}}}}}}};
}

}  // namespace

Document openapi_document() {
  const GetPath kGets[] = {
      {"/api/v1/info", "What the store holds", kJson, {}},
      {"/api/v1/los", "Whether two points see each other, and the profile between them", kJson, {"from", "to"}},
      {"/api/v1/place", "Where a place is, and the ground there", kJson, {"at"}, false},
      {"/api/v1/profile", "The surface along a line", kJson, {"from", "to"}},
      {"/tin.glb", "The triangulation of a window as glTF", "model/gltf-binary", {"bbox"}},
      {"/tiles/heights/{z}/{x}/{y}", "Heights of the ground as float32", "application/octet-stream", {}},
      {"/tiles/theme/{name}/{z}/{x}/{y}", "Outlines of a theme's buildings", kJson, {}},
      {"/api/v1/uploads/{name}", "The places in a file that was sent", kJson, {}},
      {"/api/v1/jobs/{id}", "How far a job is", kJson, {}},
      {"/api/v1/jobs/{id}/{file}", "A file that a job has written", "application/octet-stream", {}}};
  Document paths = Document::object();
  for (const GetPath& get : kGets) paths[get.path]["get"] = get_operation(get);
  paths["/api/v1/jobs"]["post"] = start_operation();
  paths["/api/v1/jobs/{id}"]["delete"] = delete_operation("/api/v1/jobs/{id}", "Cancel a job and remove its files");
  paths["/api/v1/uploads"]["post"] = upload_operation();
  paths["/api/v1/uploads/{name}"]["delete"] = delete_operation("/api/v1/uploads/{name}", "Remove a file that was sent");
  return {{"openapi", "3.1.0"},
          {"info", {{"title", "itin serve"}, {"version", ITIN_VERSION}}},
          {"paths", paths},
          {"components", {{"schemas", schemas()}}}};
}

}  // namespace itin::cli
