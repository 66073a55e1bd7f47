#include <cmath>
#include <span>

#include <profile/rain_loss.hpp>

namespace itin::profile {

namespace {

/// A term a exp(-((log10 f - b) / c)^2), and the sum of such terms with m log10 f + c: P.838-3 equations (2) and (3).
struct RainTerm {
  double a, b, c;
};

double sum_of(std::span<const RainTerm> terms, double m, double c, double log_f) {
  double sum = m * log_f + c;
  for (const RainTerm& t : terms) sum += t.a * std::exp(-std::pow((log_f - t.b) / t.c, 2));
  return sum;
}

/// P.838-3 tables 1 to 4.
constexpr RainTerm kHorizontalK[] = {{-5.33980, -0.10008, 1.13098},
                                     {-0.35351, 1.26970, 0.45400},
                                     {-0.23789, 0.86036, 0.15354},
                                     {-0.94158, 0.64552, 0.16817}};
constexpr RainTerm kVerticalK[] = {{-3.80595, 0.56934, 0.81061},
                                   {-3.44965, -0.22911, 0.51059},
                                   {-0.39902, 0.73042, 0.11899},
                                   {0.50167, 1.07319, 0.27195}};
constexpr RainTerm kHorizontalAlpha[] = {{-0.14318, 1.82442, -0.55187},
                                         {0.29591, 0.77564, 0.19822},
                                         {0.32177, 0.63773, 0.13164},
                                         {-5.37610, -0.96230, 1.47828},
                                         {16.1721, -3.29980, 3.43990}};
constexpr RainTerm kVerticalAlpha[] = {{-0.07771, 2.33840, -0.76284},
                                       {0.56727, 0.95545, 0.54039},
                                       {-0.20238, 1.14520, 0.26809},
                                       {-48.2991, 0.791669, 0.116226},
                                       {48.5833, 0.791459, 0.116479}};

struct RainCoefficients {
  double k, alpha;
};

/// The coefficients for a path of this elevation and polarisation, P.838-3 equations (4) and (5).
RainCoefficients coefficients_of(const RainPath& path) {
  const double log_f = std::log10(path.frequency_ghz);
  const double kh = std::pow(10, sum_of(kHorizontalK, -0.18961, 0.71147, log_f));
  const double kv = std::pow(10, sum_of(kVerticalK, -0.16398, 0.63297, log_f));
  const double alpha_h = sum_of(kHorizontalAlpha, 0.67849, -1.95537, log_f);
  const double alpha_v = sum_of(kVerticalAlpha, -0.053739, 0.83433, log_f);
  const double cosine = std::cos(path.elevation_rad);
  const double lean = cosine * cosine * (path.polarisation == Polarisation::kHorizontal ? 1 : -1);
  const double k = (kh + kv + (kh - kv) * lean) / 2;
  return {k, (kh * alpha_h + kv * alpha_v + (kh * alpha_h - kv * alpha_v) * lean) / (2 * k)};
}

/// The factor between what is exceeded for `percent` of the year and for 0.01 %. The power of 0.8 in C0 is that of the
/// frequency, not of its logarithm.
double scaled_to(double percent, double frequency_ghz) {
  const double c0 = frequency_ghz < 10 ? 0.12 : 0.12 + 0.4 * std::log10(std::pow(frequency_ghz / 10, 0.8));
  const double c1 = std::pow(0.07, c0) * std::pow(0.12, 1 - c0);
  const double c2 = 0.855 * c0 + 0.546 * (1 - c0);
  const double c3 = 0.139 * c0 + 0.043 * (1 - c0);
  return c1 * std::pow(percent, -(c2 + c3 * std::log10(percent)));
}

}  // namespace

double rain_loss_db_km(const RainPath& path, double rate_mm_h) {
  const RainCoefficients of = coefficients_of(path);
  return of.k * std::pow(rate_mm_h, of.alpha);
}

RainLoss rain_loss(const RainPath& path, double rate_mm_h) {
  constexpr double kMostReduction = 2.5;
  const RainCoefficients of = coefficients_of(path);
  const double d = path.length_km;
  const double divisor =
      0.477 * std::pow(d, 0.633) * std::pow(rate_mm_h, 0.073 * of.alpha) * std::pow(path.frequency_ghz, 0.123) -
      10.579 * (1 - std::exp(-0.024 * d));
  const double effective = d * (divisor * kMostReduction < 1 ? kMostReduction : 1 / divisor);
  const double specific = of.k * std::pow(rate_mm_h, of.alpha);
  return {specific, effective, specific * effective};
}

double rain_exceeded_db(const RainLoss& rain, double frequency_ghz, double percent) {
  return rain.exceeded_db * scaled_to(percent, frequency_ghz);
}

std::optional<Outage> rain_outage(const RainLoss& rain, double frequency_ghz, double margin_db) {
  const auto exceeds = [&](double percent) { return rain_exceeded_db(rain, frequency_ghz, percent) > margin_db; };
  if (exceeds(kMostRain)) return std::nullopt;
  if (!exceeds(kLeastRain)) return Outage{kLeastRain, true};
  double rarer = kLeastRain, oftener = kMostRain;  // what is exceeded becomes less from the one to the other
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(rarer * oftener);
    (exceeds(middle) ? rarer : oftener) = middle;
  }
  return Outage{oftener, false};
}

}  // namespace itin::profile
