// Writes a store of a synthetic surface of any size:
//
//   itin_huge_store OUT.itin SIDE_KM [--seed N] [--threads N]
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <itin/parallel.hpp>

#include "huge_store/fractal_store.hpp"

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Lines final : public itin::Progress {
 public:
  void report(std::string_view stage, double fraction) override {
    constexpr double seconds_between = 10;
    if (seconds_since(last_) < seconds_between) return;
    last_ = Clock::now();
    fmt::print(stderr, "{:6.0f} s  {} {:.1f} %\n", seconds_since(start_), stage, 100 * fraction);
  }

 private:
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

int run(int argc, char** argv) {
  CLI::App app{"Writes a store of a fractal surface, posts 1 m apart"};
  std::string path;
  itin::huge::FractalStoreOptions options;
  int threads = 0;
  app.add_option("STORE", path, "The store to write, replaced where it exists")->required();
  app.add_option("SIDE_KM", options.side_km, "The side of its square; rounded up to a multiple of 512 m")->required();
  app.add_option("--seed", options.seed, "Of the surface")->capture_default_str();
  app.add_option("--threads", threads, "0: all cores")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  itin::set_thread_count(threads);
  Lines progress;
  const Clock::time_point start = Clock::now();
  const auto report = itin::huge::write_fractal_store(path, options, progress);
  const double seconds = seconds_since(start);
  const auto posts = static_cast<double>(report.posts);
  const auto bytes = static_cast<double>(std::filesystem::file_size(path));
  fmt::print(
      "{} m square, {} posts, {:.1f} to {:.1f} m high, {:.0f} bytes ({:.3f} a post) in {:.1f} s, {:.2f} million "
      "posts per second\n",
      report.side_m, report.posts, report.lowest, report.highest, bytes, bytes / posts, seconds,
      posts / seconds * 1e-6);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "itin_huge_store: {}\n", e.what());
    return 1;
  }
}
