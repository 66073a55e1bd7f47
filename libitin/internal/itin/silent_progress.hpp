// Progress of a mere part of a call.
//
//   SilentProgress quiet(progress);
//   const Tin tin = triangulate(store, window, detail, quiet);   // ends when the call is cancelled, and shows nothing
#pragma once

#include <string_view>

#include <itin/progress.hpp>

namespace itin {

/// Passes on that the call is to end, but not how far its part has come.
class SilentProgress final : public Progress {
 public:
  explicit SilentProgress(const Progress& whole) : whole_(whole) {}
  void report(std::string_view, double) override {}
  bool cancelled() const override { return whole_.cancelled(); }

 private:
  const Progress& whole_;
};

}  // namespace itin
