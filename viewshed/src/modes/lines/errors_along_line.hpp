// The errors of the heights that a sight line meets, in many realisations: drawn along the line, one vertex after
// another.
//
//   const ErrorRealisations realisations;
//   ErrorsAlongLine errors(tin, correlation, realisations);   // for many lines
//   errors.begin(under_the_eye, under_the_target);
//   for (std::uint32_t vertex : ...) use(errors.from(), errors.to(), errors.of(vertex));
//
// Vertices' errors are normal, of standard deviation 1, and correlated as exp(-x / L). Each error is drawn given the
// errors of both ends and of the two vertices asked for before. With L = 0, and with the edges in their order along the
// line, this is exact; otherwise it is close, as exp(-x / L) is nearly a Markov process.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <itin/tin.hpp>

#include "modes/lines/error_realisations.hpp"

namespace itin::viewshed {

/// An error that is a weighted sum of the errors of up to three vertices; the sum of none is 0.
struct ErrorSum {
  std::array<std::uint32_t, 3> vertex{};
  std::array<double, 3> weight{};
  std::size_t count = 0;
  friend bool operator==(const ErrorSum&, const ErrorSum&) = default;
};

/// Serves one thread at a time. Takes 10 kB.
class ErrorsAlongLine {
 public:
  using Errors = std::array<float, ErrorRealisations::kCount>;  ///< one per realisation

  /// `correlation`: L in grid units. All must outlive it.
  ErrorsAlongLine(const Tin& tin, double correlation, const ErrorRealisations& realisations);

  /// Begins a line between places whose heights have these errors. Values of the eye are reused where the line before
  /// began at the same eye.
  void begin(const ErrorSum& from, const ErrorSum& to);
  const Errors& from() const { return ends_[0].errors; }
  const Errors& to() const { return ends_[1].errors; }
  /// Returns the errors of a vertex, which hold until two other vertices have been asked for.
  const Errors& of(std::uint32_t vertex);

 private:
  /// An error that has been drawn.
  struct Drawn {
    ErrorSum sum;
    std::array<double, 2> with_ends{};  ///< covariances
    std::uint32_t used = 0;             ///< when a vertex was last asked for; 0 where none has been drawn
    Errors errors{};
  };
  void draw_end(std::size_t which, const ErrorSum& sum, std::span<const Drawn* const> given);
  void draw(Drawn& out, std::uint64_t number, std::span<const Drawn* const> given) const;
  std::uint64_t number_of(std::uint32_t vertex) const;
  double covariance(const ErrorSum& a, const ErrorSum& b) const;

  const Tin& tin_;
  double correlation_;
  const ErrorRealisations& realisations_;
  std::array<Drawn, 2> ends_;
  std::array<Drawn, 3> vertices_;
  std::uint32_t clock_ = 0;
};

}  // namespace itin::viewshed
