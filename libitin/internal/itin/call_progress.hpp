// Progress of a whole call, composed of the progress of its steps.
//
//   CallProgress call(progress);
//   const Tin tin = triangulate(store, window, detail, call.step(0.6));   // six tenths of the call
//   export_tin(tin, path, options, call.step(1));                         // all that is left
//   call.finish();
//
// What the caller sees never decreases, whatever threads and steps report, and ends at 1.
#pragma once

#include <mutex>
#include <string>
#include <string_view>

#include <itin/progress.hpp>

namespace itin {

/// Composes the progress of a call. Until a step begins, the whole call is one step. `whole` must outlive it.
class CallProgress final : public Progress {
 public:
  explicit CallProgress(Progress& whole) : whole_(whole) {}

  /// Ends the step, and begins one that takes about this share of what is left of the call. Returns this.
  Progress& step(double share);
  /// Reports that `fraction` of the step is done.
  void report(std::string_view stage, double fraction) override;
  bool cancelled() const override { return whole_.cancelled(); }
  /// Reports that the call is done.
  void finish();

 private:
  void report_whole(std::string_view stage, double fraction);

  Progress& whole_;
  std::mutex mutex_;
  bool stepped_ = false;        ///< a step has begun
  double begin_ = 0, end_ = 1;  ///< the step's part of the whole call, 0 to 1
  double reported_ = -1;
  std::string stage_;
};

}  // namespace itin
