// Published profiles, kept as their heights (tests/profile/data/*.heights).
#pragma once

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include <profile/profile.hpp>

namespace itin::test {

inline profile::Profile published_profile(const std::string& name) {
  const std::string path = std::string(ITIN_SOURCE_DIR) + "/tests/profile/data/" + name + ".heights";
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  double step = 0, last = 0;
  std::vector<std::pair<double, double>> clutter;
  std::string word;
  while (file >> word && word != "heights") {
    if (word == "step_km") file >> step;
    if (word == "last_km") file >> last;
    if (word == "clutter") {
      double at = 0, height = 0;
      file >> at >> height;
      clutter.emplace_back(at, height);
    }
    file.ignore(1000, '\n');
  }
  profile::Profile profile;
  for (double height = 0; file >> height;) {
    profile::ProfilePoint p;
    p.distance_m = static_cast<double>(profile.points.size()) * step * 1000;
    p.ground_m = height;
    profile.points.push_back(p);
  }
  profile.points.back().distance_m = profile.length_m = last * 1000;
  for (const auto& [at, height] : clutter) {
    profile.points[static_cast<std::size_t>(std::lround(at / step))].clutter_m = height;
  }
  return profile;
}

/// Heights at equal distances.
inline profile::Profile even_profile(double step_m, std::initializer_list<double> heights) {
  profile::Profile profile;
  for (const double height : heights) {
    profile::ProfilePoint p;
    p.distance_m = step_m * static_cast<double>(profile.points.size());
    p.ground_m = height;
    profile.points.push_back(p);
  }
  profile.length_m = profile.points.back().distance_m;
  return profile;
}

}  // namespace itin::test
