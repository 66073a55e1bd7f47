#include "modes/lines/errors_along_line.hpp"

#include <algorithm>
#include <cmath>

namespace itin::viewshed {

namespace {

constexpr std::size_t kMostGiven = 4;
using Covariances = std::array<std::array<double, kMostGiven>, kMostGiven>;  ///< the lower triangle

/// How a normal variable depends on others: its mean is the sum of each times its `weight`, and its standard deviation
/// about that is `deviation`.
struct Regression {
  std::array<double, kMostGiven> weight{};
  double deviation = 0;
};

/// Takes the covariances of the others `among` each other and `with` the variable itself, whose variance is `variance`.
/// Passes over others that the ones before them determine.
Regression regress(std::size_t count, const Covariances& among, const std::array<double, kMostGiven>& with,
                   double variance) {
  constexpr double kTiniest = 1e-9;
  Covariances root{};  // Cholesky's
  std::array<double, kMostGiven> part{};
  for (std::size_t i = 0; i < count; ++i) {
    double pivot = among[i][i];
    for (std::size_t k = 0; k < i; ++k) pivot -= root[i][k] * root[i][k];
    if (pivot <= kTiniest) continue;
    root[i][i] = std::sqrt(pivot);
    for (std::size_t j = i + 1; j < count; ++j) {
      double rest = among[j][i];
      for (std::size_t k = 0; k < i; ++k) rest -= root[j][k] * root[i][k];
      root[j][i] = rest / root[i][i];
    }
    double rest = with[i];
    for (std::size_t k = 0; k < i; ++k) rest -= root[i][k] * part[k];
    part[i] = rest / root[i][i];
  }
  Regression result;
  for (std::size_t i = count; i-- > 0;) {
    if (root[i][i] == 0) continue;
    double rest = part[i];
    for (std::size_t k = i + 1; k < count; ++k) rest -= root[k][i] * result.weight[k];
    result.weight[i] = rest / root[i][i];
    variance -= part[i] * part[i];
  }
  result.deviation = std::sqrt(std::max(variance, 0.0));
  return result;
}

}  // namespace

ErrorsAlongLine::ErrorsAlongLine(const Tin& tin, double correlation, const ErrorRealisations& realisations)
    : tin_(tin), correlation_(correlation), realisations_(realisations) {}

void ErrorsAlongLine::begin(const ErrorSum& from, const ErrorSum& to) {
  // At first the ends have the errors of no vertex, that is, of a place that does not err.
  if (ends_[0].sum != from) draw_end(0, from, {});
  const std::array<const Drawn*, 1> eye{&ends_[0]};
  draw_end(1, to, eye);
  for (Drawn& vertex : vertices_) vertex.used = 0;
}

/// First ends in one triangle share their random numbers, and so do second ends.
void ErrorsAlongLine::draw_end(std::size_t which, const ErrorSum& sum, std::span<const Drawn* const> given) {
  ends_[which].sum = sum;
  // These numbers are beyond those of vertices.
  draw(ends_[which], (which + 1) << 62 | number_of(sum.vertex[0]), given);
}

const ErrorsAlongLine::Errors& ErrorsAlongLine::of(std::uint32_t vertex) {
  const auto is_asked = [&](const Drawn& d) { return d.used > 0 && d.sum.vertex[0] == vertex; };
  auto asked = std::find_if(vertices_.begin(), vertices_.end(), is_asked);
  if (asked == vertices_.end()) {
    asked = std::min_element(vertices_.begin(), vertices_.end(),
                             [](const Drawn& a, const Drawn& b) { return a.used < b.used; });
    std::array<const Drawn*, kMostGiven> given{&ends_[0], &ends_[1]};
    std::size_t count = 2;
    for (const Drawn& d : vertices_)
      if (&d != &*asked && d.used > 0) given[count++] = &d;
    asked->sum = {{vertex}, {1}, 1};
    draw(*asked, number_of(vertex), std::span(given).first(count));
  }
  asked->used = ++clock_;
  return asked->errors;
}

/// A number for the vertex's place, so that a vertex errs alike in every window that it is part of.
std::uint64_t ErrorsAlongLine::number_of(std::uint32_t vertex) const {
  const GridPoint& p = tin_.vertices[vertex];
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(p.x + kGridHalfSide)) << 31 |
         static_cast<std::uint32_t>(p.y + kGridHalfSide);
}

/// Sets the errors of `out.sum`, given the errors of both ends, or of the first end, and of vertices. The realisations
/// of `number` decide what these leave open.
void ErrorsAlongLine::draw(Drawn& out, std::uint64_t number, std::span<const Drawn* const> given) const {
  Covariances among{};
  std::array<double, kMostGiven> with{};
  for (std::size_t i = 0; i < given.size(); ++i) {
    with[i] = covariance(out.sum, given[i]->sum);
    for (std::size_t j = 0; j <= i; ++j)
      among[i][j] = j < 2 ? given[i]->with_ends[j] : covariance(given[i]->sum, given[j]->sum);
  }
  const double variance = covariance(out.sum, out.sum);
  const Regression on = regress(given.size(), among, with, variance);
  if (given.size() < 2) with[given.size()] = variance;
  out.with_ends = {with[0], with[1]};

  const auto own = realisations_.of(number);
  const auto deviation = static_cast<float>(on.deviation);
  Errors errors;  // not out's, so that the compiler knows that none of them overlap
  for (std::size_t w = 0; w < errors.size(); ++w) errors[w] = deviation * own[w];
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto weight = static_cast<float>(on.weight[i]);
    const float* const by = given[i]->errors.data();
    if (weight != 0)
      for (std::size_t w = 0; w < errors.size(); ++w) errors[w] += weight * by[w];
  }
  out.errors = errors;
}

double ErrorsAlongLine::covariance(const ErrorSum& a, const ErrorSum& b) const {
  double sum = 0;
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t j = 0; j < b.count; ++j) {
      const GridPoint &p = tin_.vertices[a.vertex[i]], &q = tin_.vertices[b.vertex[j]];
      const double dx = 1.0 * p.x - q.x, dy = 1.0 * p.y - q.y, weight = a.weight[i] * b.weight[j];
      if (dx == 0 && dy == 0) {
        sum += weight;
      } else if (correlation_ > 0) {
        sum += weight * std::exp(-std::sqrt(dx * dx + dy * dy) / correlation_);
      }
    }
  }
  return sum;
}

}  // namespace itin::viewshed
