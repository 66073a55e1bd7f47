// Law 7: the same input gives the same bytes, with one thread or many, and without threads at all.
#include <cstdlib>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "cli/shell.hpp"

namespace itin::test {

namespace {

/// Everything one program makes of the bundled terrain, by file name. Stores are compared by what is taken out of them,
/// for they tell when each source was imported.
std::map<std::string, std::string> products(const std::string& program, const std::string& threads) {
  const Shell shell(program);
  const std::string commands[] = {
      "gdal_translate -q -srcwin 160 320 200 200 \"$DEMO/cardiff.tif\" garth.tif",
      "itin import store.itin garth.tif --quiet " + threads,
      "itin tin store.itin --all -o all.ply --quiet " + threads,
      "itin tin store.itin --all --tolerance 4 -o coarse.gpkg --quiet " + threads,
      "itin tin store.itin --disc 312000,189000,1500 --topology vertex -o stars.json --quiet " + threads,
      "itin viewshed store.itin --observer 312000,189000,2 --radius 4000 --cell 20 -o seen.tif --image seen.png "
      "--quiet " +
          threads,
      "itin viewshed store.itin --observer 312000,189000,2 --observer 313000,188000,2 --mode count --tolerance 2 "
      "--radius 4000 --cell 25 -o count.tif --quiet " +
          threads,
      "awk 'BEGIN { print \"id,x1,y1,h1,x2,y2,h2\"; for (i = 0; i < 200; ++i) print i \",\" 310000 + i * 37 % 4000 "
      "\",\" "
      "188000 + i * 53 % 3000 \",5,\" 310000 + i * 71 % 4000 \",\" 188000 + i * 29 % 3000 \",20\" }' > links.csv",
      "mkdir r; itin los store.itin --links links.csv -o seen.csv --frequency 6 --effective-earth 4/3 --report "
      "'r/{id}.pdf' --report 'r/{id}.json' --report 'r/{id}.gpkg' --quiet " +
          threads,
      "head -11 links.csv > few.csv; itin los store.itin --links few.csv -o few-seen.csv --report 'r/{id}.csv' "
      "--report "
      "'r/{id}.svg' --report 'r/{id}.png' --report 'r/{id}.html' --report 'r/{id}.kml' --quiet " +
          threads,
      "ls r | wc -l > reports.txt; sha256sum r/* >> reports.txt",
  };
  for (const std::string& command : commands) {
    const Outcome outcome = shell.run(command);
    EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
  }
  std::map<std::string, std::string> files;
  for (const char* name :
       {"all.ply", "coarse.gpkg", "stars.json", "seen.tif", "seen.png", "count.tif", "seen.csv", "reports.txt"}) {
    files[name] = shell.read(name);
    EXPECT_FALSE(files[name].empty()) << name;
  }
  EXPECT_EQ(files["reports.txt"].substr(0, 4), "650\n");
  return files;
}

void expect_same(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b) {
  for (const auto& [name, bytes] : a) {
    EXPECT_TRUE(bytes == b.at(name)) << name << " differs: " << bytes.size() << " and " << b.at(name).size()
                                     << " bytes";
  }
}

TEST(SameBytes, WhateverTheNumberOfThreads) {
  expect_same(products(ITIN_PROGRAM, "--threads 1"), products(ITIN_PROGRAM, "--threads 7"));
}

TEST(SameBytes, FromTheSerialBuild) {
  const char* serial = std::getenv("ITIN_SERIAL_PROGRAM");
  if (serial == nullptr) GTEST_SKIP() << "set ITIN_SERIAL_PROGRAM to the serial build's program, as scripts/test does";
  expect_same(products(ITIN_PROGRAM, ""), products(serial, ""));
}

}  // namespace

}  // namespace itin::test
