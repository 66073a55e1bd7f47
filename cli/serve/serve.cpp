// itin serve: the live map.

#include <algorithm>
#include <iostream>
#include <spawn.h>
#include <unistd.h>

#include <fmt/format.h>

#include <itin/beside.hpp>
#include <itin/error.hpp>
#include <itin/gdal_ready.hpp>
#include <itin/parallel.hpp>

#include "options/memory_option.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/interruption.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"
#include "serve/calls/admission.hpp"
#include "serve/ground/served_store.hpp"
#include "serve/http/http_server.hpp"
#include "serve/routes.hpp"

namespace itin::cli {

namespace {

constexpr std::uint16_t kUsualPort = 8080;
constexpr std::uint64_t kUsualMemory = std::uint64_t{1} << 30;
constexpr std::uint64_t kLeastMemory = std::uint64_t{64} << 20;

/// Shows a page in the browser that the desktop has for it. Whoever has none still has the printed URL, and need not
/// read of all that xdg-open has tried.
void open_in_browser(std::string url) {
  std::string shell = "sh", option = "-c",
              call =
                  "xdg-open \"$0\" >/dev/null 2>&1 || "
                  "echo 'itin: warning: --open: no browser opened; open the printed URL by hand' >&2";
  char* const words[] = {shell.data(), option.data(), call.data(), url.data(), nullptr};
  pid_t process = 0;
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  posix_spawnp(&process, words[0], &files, nullptr, words, environ);
  posix_spawn_file_actions_destroy(&files);
}

class ServeVerb final : public Verb {
 public:
  std::string name() const override { return "serve"; }
  std::string summary() const override { return "Show the store as a live map in the browser"; }

  void declare(CLI::App& app) override {
    reads(app.add_option("STORE", store_, "The store")->required());
    begin_group(app, "Server");
    app.add_option("--port", port_text_, "The port to listen on; 0: any that is free (default: 8080)")->type_name("N");
    app.add_option("--host", place_.host,
                   "The address to listen on (default: 127.0.0.1, which only this machine reaches); any other needs "
                   "--allow-host")
        ->type_name("ADDRESS");
    app.add_option("--allow-host", names_,
                   "A name, with or without a port, by which browsers may call the server; may be given again")
        ->type_name("NAME")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_flag("--open", open_, "Open the map in the browser");
    memory_.declare(app,
                    "Memory for surfaces, the ground of cells and jobs, for example 4G, at least 64M; the result does "
                    "not depend on it (default: 1G)");
  }

  void validate() override {
    place_.port = kUsualPort;
    if (!port_text_.empty()) place_.port = static_cast<std::uint16_t>(parse_whole("--port", port_text_, 0, 65535));
    memory_bytes_ = memory_.bytes().value_or(kUsualMemory);
    if (memory_bytes_ < kLeastMemory) throw InputError("--memory: the server needs at least 64M");
  }

  Document parameters() const override { return {{"store", store_}, {"host", place_.host}, {"port", place_.port}}; }

  /// Ends by being interrupted.
  Result execute(Progress& progress) override {
    const std::future<void> rasters = beside(make_gdal_ready);
    ServedStore served(store_, memory_bytes_);
    HttpServer server(place_);
    if (!server.is_loopback() && names_.empty())
      throw InputError(
          fmt::format("--host '{}': other machines may reach it; say by --allow-host NAME what browsers "
                      "call this one",
                      place_.host));
    Admission admission(names(), server.port(), random_key());
    const std::string url = admission.url();
    Routes routes(served, std::move(admission), std::max(1, thread_count() / 2), progress);
    rasters.wait();
    expect_interruption();
    std::cout << url << std::endl;
    if (open_) open_in_browser(url);
    server.run(routes, progress);
    return {};
  }

 private:
  /// What browsers may call the server, what they are told to call it first.
  std::vector<std::string> names() const {
    std::vector<std::string> names = names_;
    const bool is_ip6 = place_.host.find(':') != std::string::npos;
    names.push_back(is_ip6 ? fmt::format("[{}]", place_.host) : place_.host);
    return names;
  }

  std::string store_, port_text_;
  HttpServer::Place place_{.host = "127.0.0.1"};
  std::vector<std::string> names_;
  bool open_ = false;
  MemoryOption memory_;
  std::uint64_t memory_bytes_ = 0;
};

}  // namespace

std::unique_ptr<Verb> make_serve_verb() {
  return std::make_unique<ServeVerb>();
}

}  // namespace itin::cli
