#include "serve/live/live_view.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/hidden_eyes.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/result_raster.hpp>

#include "serve/ground/given_options.hpp"
#include "serve/live/tile_batch.hpp"
#include "viewshed/view_warnings.hpp"

namespace itin::cli {

namespace {

/// Modes whose values tell which observers or features they are about, cell by cell, are the command line's alone.
bool is_live(viewshed::Mode mode) {
  return mode != viewshed::Mode::kWhich && mode != viewshed::Mode::kNearest && mode != viewshed::Mode::kBlocker;
}

Document begun_document(const LiveNumber& number, const viewshed::Result& result) {
  const CellOrigin origin = cell_origin(result.grid);
  Document begun = numbered("begun", number);
  begun["mode"] = viewshed::mode_name(result.request.mode, false);
  begun["cell_m"] = result.grid.cell_width();
  begun["column"] = origin.column;
  begun["row"] = origin.row;
  begun["columns"] = result.grid.columns();
  begun["rows"] = result.grid.rows();
  begun["ground_m"] = result.ground_m;
  begun["kind"] = value_kind(result);
  return begun;
}

/// The call that writes the same cells.
std::string command_of(const ServedStore& served, const Document& options) {
  std::vector<std::string> words{"itin", "viewshed", served.store().path()};
  for (const std::string& argument : arguments_of(options)) words.push_back(argument);
  words.insert(words.end(), {"-o", "viewshed.tif"});
  return command_line(words);
}

/// What the only observer stands within, where it stands on the ground.
Document within_document(const Store& store, const viewshed::Result& result) {
  const viewshed::Request& request = result.request;
  if (request.observers.size() != 1 || request.observers_on_surface) return nullptr;
  const auto cover = viewshed::cover_at(store, request.observers.front().position, request.detail, request.themes);
  if (!cover) return nullptr;
  return {{"theme", cover->theme}, {"top_m", cover->top - result.ground_m.front()}};
}

Document done_document(const ServedStore& served, const LiveNumber& number, const ViewOptions& view,
                       const viewshed::Result& result, std::vector<std::string> warnings, Progress& progress) {
  const viewshed::MissingGround missing = viewshed::missing_ground(served.store(), result, progress);
  Document found = viewshed::viewshed_document(served.metadata(), result);
  viewshed::add_missing_ground(missing, found);
  add_view_warnings(served.metadata(), view, result, missing, warnings);
  Document done = numbered("done", number);
  for (const char* name : {"surface", "refraction", "grid", "cells", "area_m2", "share_without_data"})
    done[name] = std::move(found[name]);
  done["ground_m"] = result.ground_m;
  done["within"] = within_document(served.store(), result);
  done["warnings"] = std::move(warnings);
  return done;
}

/// Throws InputError where the cells are more than a live view may have.
void require_few_cells(const ServedStore& served, const viewshed::Request& request) {
  if (!request.cell_size) return;
  const Box data = served.metadata().grid.box(served.metadata().bounds);
  Box asked;
  for (const viewshed::Observer& observer : request.observers)
    asked.extend(intersection(data, request.radius ? square_about(observer.position, *request.radius) : data));
  const double cells = asked.width() / *request.cell_size * (asked.height() / *request.cell_size);
  if (cells > static_cast<double>(served.most_cells()))
    throw InputError(
        fmt::format("--cell: {:.3g} cells are too many for a live view, which has at most {}; give a larger "
                    "--cell, a smaller --radius, or the server more --memory",
                    cells, served.most_cells()));
}

/// Waits for a client that is far behind, so that no more than one result waits for it.
void wait_for(const LiveConnection& client, const Progress& progress) {
  while (client.unsent() > kMostUnsent) {
    progress.throw_if_cancelled();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/// Cells on their way to the client, who is told first what they are about.
class ShownCells {
 public:
  ShownCells(const LiveNumber& number, LiveConnection& to, LatestWork::Run& run)
      : number_(number), to_(to), run_(run), tiles_(number, to) {}

  void add(const viewshed::Result& result, const viewshed::DecidedCells& cells) {
    begin(result);
    // The first pass is over.
    if (first_step_ > cells.step) run_.note_shown();
    first_step_ = std::max(first_step_, cells.step);
    tiles_.add(result, cells);
  }

  void finish(const viewshed::Result& result) {
    begin(result);
    tiles_.flush();
    run_.note_shown();
  }

 private:
  void begin(const viewshed::Result& result) {
    if (!std::exchange(begun_, true)) to_.send_text(json_text(begun_document(number_, result)));
  }

  LiveNumber number_;
  LiveConnection& to_;
  LatestWork::Run& run_;
  TileBatch tiles_;
  bool begun_ = false;
  std::int64_t first_step_ = 0;
};

}  // namespace

std::vector<std::string> live_modes() {
  std::vector<std::string> names;
  // The modes of radio have options of their own.
  const auto modes = viewshed::modes_of_sight();
  for (std::size_t i = 0; i < modes.size(); ++i)
    if (is_live(static_cast<viewshed::Mode>(i))) names.emplace_back(modes[i]);
  return names;
}

void take_view(const Document& options, ViewOptions& view) {
  CLI::App app;
  view.declare_view(app);
  view.declare_surface(app);
  take_arguments(app, arguments_of(options));
  refuse_files(app);
  view.validate();
  if (view.foliage().given()) throw InputError("--foliage: woods are solid in live views; use the command line");
  if (view.has_rings()) throw InputError("--rings: live views have one tolerance; give --tolerance");
  if (view.certified() || !is_live(view.request().mode))
    throw InputError(
        fmt::format("--mode: live views have one of {}; others are the command line's", fmt::join(live_modes(), ", ")));
}

void show_view(ServedStore& served, const LiveNumber& number, const Document& options, LiveConnection& to,
               LatestWork::Run& run) {
  const auto start = std::chrono::steady_clock::now();
  served.require_unchanged();
  ViewOptions view;
  take_view(options, view);
  std::vector<std::string> warnings;
  const viewshed::Request& request = view.complete(served.store(), warnings, run);
  require_few_cells(served, request);
  const auto surface = served.surface(request.detail, request.themes);
  wait_for(to, run);
  const CallPlace place(served.places(), run);
  ShownCells shown(number, to, run);
  const viewshed::Result result =
      surface->views.compute(request, run, [&](const auto& decided, const auto& cells) { shown.add(decided, cells); });
  served.require_unchanged();
  shown.finish(result);
  Document done = done_document(served, number, view, result, std::move(warnings), run);
  done["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  done["command"] = command_of(served, options);
  to.send_text(json_text(done));
}

}  // namespace itin::cli
