// What the server answers, by path.
#pragma once

#include <itin/progress.hpp>

#include "serve/calls/admission.hpp"
#include "serve/calls/jobs.hpp"
#include "serve/calls/server_folder.hpp"
#include "serve/calls/tin_windows.hpp"
#include "serve/calls/uploads.hpp"
#include "serve/ground/served_store.hpp"
#include "serve/ground/tile_grid.hpp"
#include "serve/http/http_server.hpp"

namespace itin::cli {

class Routes final : public HttpHandler {
 public:
  /// `served` and `progress`, which ends what is being answered, must outlive the routes. Jobs use `threads`.
  Routes(ServedStore& served, Admission admission, int threads, Progress& progress);

  std::optional<HttpResponse> refusal(const HttpRequest& request) const override;
  std::size_t most_bytes(const HttpRequest& request) const override;
  HttpResponse answer(const HttpRequest& request) override;
  std::unique_ptr<LiveClient> open(std::shared_ptr<LiveConnection> connection) override;

 private:
  HttpResponse routed(const HttpRequest& request);
  HttpResponse get(const HttpRequest& request);
  HttpResponse get_of_store(const HttpRequest& request, bool may_be_kept);
  HttpResponse window(const HttpQuery& query);
  HttpResponse tile(const std::string& path, bool may_be_kept);
  HttpResponse upload(const HttpRequest& request);
  HttpResponse sent_upload(const HttpRequest& request, const std::string& name);
  HttpResponse start_job(const HttpRequest& request);
  HttpResponse job(const HttpRequest& request, const std::string& path);
  HttpResponse job_file(const std::string& id, const std::string& name) const;

  ServedStore& served_;
  Admission admission_;
  int threads_;
  Progress& progress_;
  TileGrid grid_;
  ServerFolder folder_;
  Uploads uploads_;
  TinWindows windows_;
  Jobs jobs_;
};

}  // namespace itin::cli
