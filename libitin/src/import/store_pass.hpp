// One pass of an import: it writes a store of all that another one holds and of what is added to it.
//
//   const Target target{writer, path, tolerances, interim};
//   const bool done = StorePass(target, {base, ground, additions}, options, report).run(raised, progress);
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/call_progress.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>

#include "import/footprints/footprint_file.hpp"
#include "import/point_intake.hpp"
#include "import/source/terrain_source.hpp"
#include "import/stored_sources.hpp"
#include "import/vectors/line_collection.hpp"
#include "pyramid/points/sorted_points.hpp"
#include "pyramid/pyramid.hpp"
#include "store/set_aside.hpp"
#include "store/store_writer.hpp"

namespace itin {

/// What one import adds to a store, and what it takes out.
struct Additions {
  ImportPlan plan;
  std::vector<FootprintFile> footprints;
  Sources removed = {};  ///< sources of features that stand, by their numbers in the store before

  /// Whether nothing is added, as in every pass after the first.
  bool empty() const { return plan.sources.empty() && plan.lines.empty() && footprints.empty(); }
};

/// The place of the store, and the place of an interim store that precedes it.
struct Target {
  StoreWriter& writer;
  std::string path;
  std::vector<double> tolerances;
  std::string interim = {};  ///< the path of the interim store
  bool last = false;         ///< whether the pass must write the store itself, whatever is left to do
};

/// What a pass makes the store from. The stores may be null.
struct PassSources {
  const Store* base;    ///< the store whose contents the new one takes over
  const Store* ground;  ///< features are raised on it; null: lines are laid as they were imported, footprints only kept
  bool keeps_ground;    ///< whether the new store has this ground byte for byte (pyramid/kept_ground.hpp)
  Additions& additions;
};

class StorePass {
 public:
  /// All arguments must outlive it. The counts are added to the report.
  StorePass(const Target& target, const PassSources& of, const ImportOptions& options, ImportReport& report);

  /// Runs the pass. Features with heights are raised on the ground, and cut its lines there. Returns false where
  /// features need another pass: they were not raised, or the ground that comes out is another one than they were
  /// raised on. Then an interim store was written instead, which has no points at other levels than the full surface's,
  /// and the next pass goes on from it.
  bool run(RaisedFeaturesReport& raised, Progress& progress);

  /// Returns the numbers of the sources that were added, in the new store; known after run().
  const std::vector<std::uint16_t>& added() const { return added_; }

 private:
  Sources replacing_lines() const;
  void require_numbers() const;
  void collect(Progress& progress);
  void number_sources();
  bool is_added(std::size_t source) const;
  void add_source(TerrainSource& source, Progress& progress);
  void add_lines(LineLayer& layer, Progress& progress);
  void add_footprints(FootprintFile& file);
  std::uint16_t next_number() const { return static_cast<std::uint16_t>(sources_.size()); }
  SortedPoints sorted_points(Progress& progress);
  void add_line_vertices(const ThemeLines& lines, SortedPoints& points) const;
  bool make_ground(CallProgress& call);
  void put_on_ground(CallProgress& call);
  PyramidReport build(const ThemeLines& lines, SortedPoints& points, const std::vector<double>& tolerances,
                      StoreWriter& writer, Progress& progress);
  void finish(const PyramidReport& pyramid, const ThemeLines& lines, StoreWriter& writer);
  void set_aside(const PyramidReport& pyramid, const ThemeLines& lines, StoreWriter& writer) const;
  bool changes_made_room() const;
  void count_made_room();
  void count(const PyramidReport& pyramid, const ThemeLines& lines);
  void commit(const PyramidReport& pyramid, const ThemeLines& lines, StoreWriter& writer);

  const Target& target_;
  const Store* base_;
  const Store* ground_;
  const bool keeps_ground_;
  Additions& additions_;
  const ImportOptions& options_;
  ImportReport& report_;
  const bool repair_;                ///< whether contours are repaired
  std::vector<SourceInfo> sources_;  ///< the new store's; the last one stands for inferred points where repair_ is true
  std::vector<std::uint16_t> added_;  ///< the numbers of the sources that were added, in the order of the call
  const Sources replacing_;  ///< the sources whose ground lines make room for, by the numbers that they come with
  PointIntake points_;
  LineCollection collection_;
  StoredPoints stored_;
};

/// The counts of what a store, which may be null, sets aside.
SetAsideCounts counts_of(const Store* store);

}  // namespace itin
