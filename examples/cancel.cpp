// A long call that shows how far it has come and is stopped after some seconds.
//
//   cancel town.itin 0.5
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <mutex>

#include <itin/itin.hpp>
#include <viewshed/visibility_index.hpp>

namespace {

using Clock = std::chrono::steady_clock;

/// Calls ask it from several threads at once. A window with a button would set an atomic flag instead.
class Deadline final : public itin::Progress {
 public:
  explicit Deadline(double seconds) : end_(Clock::now() + std::chrono::duration<double>(seconds)) {}

  void report(std::string_view stage, double fraction) override {
    const std::lock_guard lock(mutex_);
    std::cout << '\r' << stage << ' ' << static_cast<int>(100 * fraction) << " %  " << std::flush;
  }
  bool cancelled() const override { return Clock::now() >= end_; }

 private:
  std::chrono::time_point<Clock, std::chrono::duration<double>> end_;
  std::mutex mutex_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "cancel STORE.itin SECONDS\n";
    return 2;
  }
  try {
    const itin::Store store(argv[1]);
    itin::viewshed::IndexRequest request;
    request.area = itin::Window::all();
    request.cell_size = 2;
    request.radius = 200;
    Deadline deadline(std::atof(argv[2]));
    const auto index = itin::viewshed::visibility_index(store, request, deadline);
    std::cout << "\nfinished: on average " << 100 * index.mean << " % is seen\n";
  } catch (const itin::Cancelled&) {
    // Nothing is left half done: files appear only when they are complete.
    std::cout << "\nstopped in time\n";
  } catch (const itin::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
