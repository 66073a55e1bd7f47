// Law 7: the same input gives the same bytes, with one thread or many, and without threads at all.
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/shell.hpp"

namespace itin::test {

namespace {

/// Everything one program makes of the bundled terrain, by file name.
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
      "itin los store.itin --links links.csv -o seen.csv --frequency 6 --effective-earth 4/3 --quiet " + threads,
      "mkdir r; head -41 links.csv > some.csv; itin los store.itin --links some.csv -o some-seen.csv --frequency 6 "
      "--effective-earth 4/3 --report 'r/{id}.pdf' --report 'r/{id}.json' --report 'r/{id}.gpkg' --quiet " +
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
  EXPECT_EQ(files["reports.txt"].substr(0, 4), "170\n");
  return files;
}

void expect_same(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b) {
  for (const auto& [name, bytes] : a) {
    EXPECT_TRUE(bytes == b.at(name)) << name << " differs: " << bytes.size() << " and " << b.at(name).size()
                                     << " bytes";
  }
}

/// The bytes of a store of terrain, roads, buildings and ground that replaces some, imported in that folder from copies
/// of another age.
std::string store_in(const Shell& shell, const std::string& folder, const std::string& threads) {
  const std::string in = "cd " + folder + "; ",
                    import = in + "itin import " + folder + ".itin --quiet " + threads + " ";
  const std::string commands[] = {
      "mkdir " + folder,
      in + "cp \"$DEMO\"/alexandria-dtm.tif \"$DEMO\"/alexandria-buildings.geojson .",
      in + "gdal_translate -q -srcwin 20 20 60 60 -tr 1 1 alexandria-dtm.tif fine.tif",
      in + "ogr2ogr -f GeoJSON -nlt LINESTRING roads.geojson alexandria-buildings.geojson",
      in + "touch -d 200" + std::to_string(folder.size()) + "-05-31 *",
      import + "\"$PWD\"/alexandria-dtm.tif",
      import + "./roads.geojson --kind roads",
      import + "alexandria-buildings.geojson --kind buildings --height-field HEIGHT",
      import + "fine.tif --replace",
  };
  for (const std::string& command : commands) {
    const Outcome outcome = shell.run(command);
    EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
  }
  return shell.read(folder + "/" + folder + ".itin");
}

/// Without what FORMAT.md says may differ, but for the checksum.
std::string without_times(std::string bytes) {
  const std::string name = "\"imported\":\"";
  for (std::size_t at = bytes.find(name); at != std::string::npos; at = bytes.find(name, at + 1))
    bytes.replace(at + name.size(), std::string("2024-05-31T12:00:00Z").size(), 20, '?');
  return bytes;
}

TEST(SameBytes, OfStoresWithTheTimeGiven) {
  const Shell shell;
  ::setenv("SOURCE_DATE_EPOCH", "1700000000", 1);
  const std::string one = store_in(shell, "a", "--threads 1"), two = store_in(shell, "longer", "--threads 2");
  ::unsetenv("SOURCE_DATE_EPOCH");
  EXPECT_NE(one.find("\"imported\":\"2023-11-14T22:13:20Z\""), std::string::npos);
  EXPECT_TRUE(one == two) << one.size() << " and " << two.size() << " bytes";
}

TEST(SameBytes, OfStoresButForTheTimeOfImport) {
  const Shell shell;
  const std::string one = store_in(shell, "a", "--threads 2"), two = store_in(shell, "longer", "--threads 1");
  ASSERT_EQ(one.size(), two.size());
  const std::string a = without_times(one), b = without_times(two);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) places.push_back(i);
  ASSERT_FALSE(places.empty());
  EXPECT_LE(places.back() - places.front(), 7u) << "more than a checksum";
}

TEST(SameBytes, WhateverTheNumberOfThreads) {
  expect_same(products(ITIN_PROGRAM, "--threads 1"), products(ITIN_PROGRAM, "--threads 7"));
}

TEST(SameBytes, WithoutThreads) {
  expect_same(products(ITIN_PROGRAM, ""), products(ITIN_SERIAL_PROGRAM, ""));
}

}  // namespace

}  // namespace itin::test
