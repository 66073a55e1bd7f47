#include "serve/routes.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "serve/ground/given_options.hpp"
#include "serve/ground/ground_tiles.hpp"
#include "serve/ground/los_answer.hpp"
#include "serve/ground/place_answer.hpp"
#include "serve/http/failure.hpp"
#include "serve/http/openapi.hpp"
#include "serve/http/page_answer.hpp"
#include "serve/live/live_map.hpp"
#include "serve/served_info.hpp"

namespace itin::cli {

namespace {

constexpr const char* kJobsPath = "/api/v1/jobs";

HttpResponse json_answer(const Document& document, int status = 200) {
  return {status, "application/json", json_text(document) + "\n", {cache_header(false)}};
}

HttpResponse not_found(const std::string& path) {
  return http_failure(404, fmt::format("there is nothing at {}", path));
}

/// What follows `prefix` in a path that begins with it.
std::optional<std::string> behind(const std::string& path, const std::string& prefix) {
  return path.starts_with(prefix) ? std::optional(path.substr(prefix.size())) : std::nullopt;
}

/// Whether the query asks for this version, `v`, so that another one has another address.
bool names_version(const HttpQuery& query) {
  return std::any_of(query.begin(), query.end(), [](const auto& pair) { return pair.first == "v"; });
}

HttpResponse tile_answer(std::optional<std::string> bytes, const char* type, bool may_be_kept) {
  if (!bytes) return {204, type, {}, {cache_header(may_be_kept)}};
  return {200, type, std::move(*bytes), {cache_header(may_be_kept)}};
}

}  // namespace

Routes::Routes(ServedStore& served, Admission admission, int threads, Progress& progress)
    : served_(served),
      admission_(std::move(admission)),
      threads_(threads),
      progress_(progress),
      grid_(tile_grid(served.metadata())),
      uploads_(served, folder_),
      windows_(served, uploads_, folder_, threads),
      jobs_(folder_) {}

std::optional<HttpResponse> Routes::refusal(const HttpRequest& request) const {
  auto refusal = admission_.refusal(request);
  if (refusal) refusal->headers = protective_headers();
  return refusal;
}

std::size_t Routes::most_bytes(const HttpRequest& request) const {
  return request.path == kUploadsPath ? kMostUploadBytes : kMostHttpBytes;
}

std::unique_ptr<LiveClient> Routes::open(std::shared_ptr<LiveConnection> connection) {
  return std::make_unique<LiveMap>(served_, admission_.key(), std::move(connection));
}

HttpResponse Routes::answer(const HttpRequest& request) {
  HttpResponse response;
  try {
    response = routed(request);
  } catch (const Cancelled&) {
    response = http_failure(503, "the server ends");
  } catch (const std::exception&) {
    const Failure failure = current_failure();
    response = http_failure(failure.status, failure.message);
  }
  for (auto& header : protective_headers()) response.headers.push_back(std::move(header));
  return response;
}

HttpResponse Routes::routed(const HttpRequest& request) {
  if (request.path == kJobsPath)
    return request.method == "POST" ? start_job(request) : http_failure(405, "jobs are started by POST");
  if (const auto path = behind(request.path, std::string(kJobsPath) + "/")) return job(request, *path);
  if (request.path == kUploadsPath)
    return request.method == "POST" ? upload(request) : http_failure(405, "files are sent by POST");
  if (const auto name = behind(request.path, std::string(kUploadsPath) + "/")) return sent_upload(request, *name);
  if (request.method != "GET") return http_failure(405, "this is for GET alone");
  return get(request);
}

HttpResponse Routes::get(const HttpRequest& request) {
  const std::string& path = request.path;
  const bool may_be_kept = names_version(request.query);
  if (path == "/") return page_answer("index.html", false);
  if (const auto file = behind(path, "/page/")) return page_answer(*file, may_be_kept);
  if (path == "/api/v1/openapi.json") return json_answer(openapi_document());
  return get_of_store(request, may_be_kept);
}

HttpResponse Routes::get_of_store(const HttpRequest& request, bool may_be_kept) {
  const std::string& path = request.path;
  served_.require_unchanged();
  if (const auto address = behind(path, "/tiles/")) return tile(*address, may_be_kept);
  if (path == "/tin.glb") return window(request.query);
  if (path == "/api/v1/info") return json_answer(served_info(served_, grid_));
  if (path == "/api/v1/los") return json_answer(los_answer(served_, arguments_of(request.query)));
  if (path == "/api/v1/place") return json_answer(place_answer(served_, request.query, progress_));
  if (path == "/api/v1/profile") return json_answer(profile_answer(served_, arguments_of(request.query), progress_));
  return not_found(path);
}

HttpResponse Routes::window(const HttpQuery& query) {
  auto bytes = windows_.glb(query, progress_);
  if (!bytes) return http_failure(429, "another window is being made; try again later");
  return {200, content_type_of("window.glb"), std::move(*bytes), {cache_header(false)}};
}

HttpResponse Routes::tile(const std::string& path, bool may_be_kept) {
  if (const auto rest = behind(path, "heights/"))
    if (const auto address = tile_address(*rest))
      return tile_answer(height_tile(served_, grid_, *address, progress_), "application/octet-stream", may_be_kept);
  for (const std::string& theme : outlined_themes(served_.metadata()))
    if (const auto rest = behind(path, "theme/" + theme + "/"))
      if (const auto address = tile_address(*rest))
        return tile_answer(outline_tile(served_, grid_, *address, theme), "application/json", may_be_kept);
  return not_found("/tiles/" + path);
}

HttpResponse Routes::upload(const HttpRequest& request) {
  return json_answer(uploads_.add(*upload_ending(request.content_type), request.body), 201);
}

HttpResponse Routes::sent_upload(const HttpRequest& request, const std::string& name) {
  if (request.method == "GET") {
    const auto told = uploads_.told(name);
    return told ? json_answer(*told) : not_found(request.path);
  }
  if (request.method != "DELETE") return http_failure(405, "an upload is asked about by GET, and removed by DELETE");
  return uploads_.remove(name) ? json_answer(Document::object()) : not_found(request.path);
}

HttpResponse Routes::start_job(const HttpRequest& request) {
  served_.require_unchanged();
  const Document asked = Document::parse(request.body, nullptr, false);
  const auto id = jobs_.start(job_call(served_, uploads_, asked, served_.memory_bytes() / 4, threads_));
  if (!id) return http_failure(429, "too many jobs wait; cancel one, or try again later");
  return json_answer({{"id", *id}, {"url", fmt::format("{}/{}", kJobsPath, *id)}}, 202);
}

HttpResponse Routes::job(const HttpRequest& request, const std::string& path) {
  const std::string id = path.substr(0, path.find('/'));
  if (request.method == "DELETE") return jobs_.remove(path) ? json_answer(Document::object()) : not_found(request.path);
  if (request.method != "GET") return http_failure(405, "a job is asked about by GET, and ended by DELETE");
  if (id != path) return job_file(id, path.substr(id.size() + 1));
  const auto state = jobs_.state(id);
  return state ? json_answer(*state) : not_found(request.path);
}

HttpResponse Routes::job_file(const std::string& id, const std::string& name) const {
  const auto path = jobs_.file(id, name);
  if (!path) return http_failure(404, fmt::format("the job has no file '{}'", name));
  std::ifstream file(*path, std::ios::binary);
  return {200,
          content_type_of(name),
          std::string(std::istreambuf_iterator<char>(file), {}),
          {{"Content-Disposition", fmt::format("attachment; filename=\"{}\"", path->filename().string())},
           cache_header(false)}};
}

}  // namespace itin::cli
