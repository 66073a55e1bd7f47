// Progress of what is but a part of a call.
#pragma once

#include <string_view>

#include <itin/progress.hpp>

namespace itin::viewshed {

/// Passes on that the call is to end, and nothing of how far its part has come.
class Unreported final : public Progress {
 public:
  explicit Unreported(const Progress& whole) : whole_(whole) {}
  void report(std::string_view, double) override {}
  bool cancelled() const override { return whole_.cancelled(); }

 private:
  const Progress& whole_;
};

}  // namespace itin::viewshed
