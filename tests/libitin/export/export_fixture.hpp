// A Tin to export, with holes and three sources, somewhere in the British National Grid.
#pragma once

#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <itin/progress.hpp>
#include <itin/tin_export.hpp>

#include "support/delaunay_tin.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin::test {

inline std::string wkt_of(int epsg) {
  OGRSpatialReference crs;
  crs.importFromEPSG(epsg);
  char* text = nullptr;
  crs.exportToWkt(&text);
  const std::string wkt(text);
  CPLFree(text);
  return wkt;
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class ExportTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::mt19937 random(test::seed());
    // An origin and a resolution that make most coordinates inexact in decimals.
    tin_ = random_tin(random, 400, 0.1, {{318000.1, 176000.7}, 0.01}, 500000);
    options_.crs_wkt = wkt_of(27700);
    options_.metadata_json = R"({"itin":"test","command":{"verb":"tin"}})";
  }

  std::string exported(const std::string& name) {
    const std::string path = directory_.file(name);
    export_tin(tin_, path, options_, progress_);
    return path;
  }

  TemporaryDirectory directory_;
  Tin tin_;
  TinExportOptions options_;
  NoProgress progress_;
};

}  // namespace itin::test
