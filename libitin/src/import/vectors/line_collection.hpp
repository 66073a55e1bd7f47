// Collects all lines of a store, old and new, and makes them planar.
//
// They are taken as they were imported, so that the result knows no order of import. To raise features on a ground,
// they are taken as they lie there instead: cut and moved already.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include <itin/import.hpp>
#include <itin/store.hpp>

#include "features/mesh/ground_border.hpp"
#include "features/plan/mask_index.hpp"
#include "features/raised_theme.hpp"
#include "import/source/imported_lines.hpp"
#include "pyramid/points/sorted_points.hpp"
#include "pyramid/points/source_index.hpp"
#include "pyramid/replacing_ground.hpp"
#include "pyramid/theme_lines.hpp"
#include "store/codec/point_index.hpp"
#include "store/feature_table.hpp"

namespace itin {

struct RaisedThemeReport {
  std::string name;
  std::uint64_t built = 0;  ///< features that stand
  std::vector<RaisedReport> reports;
};

/// The features raised for all imports so far.
struct RaisedFeaturesReport {
  std::uint64_t features = 0;  ///< number of features that stand
  std::uint64_t refused = 0;
  std::vector<RaisedThemeReport> themes;  ///< the themes that stand
};

/// Whether lines are taken as they were imported, or as they lie on a ground that features are to be raised on.
enum class LinesAs : std::uint8_t { imported, laid };

struct CollectedTheme {
  ThemeInfo info;
  bool raised = false;  ///< whether it has features with heights, which are made parts
  std::vector<StoredFootprint> footprints{};
  ThemeFeatures features{};
  std::vector<std::uint16_t> source_of_feature{};  ///< by number of feature
  bool gone = false;                               ///< whether nothing is left of it, as its sources are left out
  std::uint16_t first_source = 0;                  ///< chosen by a rule that does not depend on the order of import
  ChangedGround changed{};                         ///< what its raised features change
};

class LineCollection {
 public:
  LineCollection(LinesAs as, std::uint64_t memory_bytes) : as_(as), memory_bytes_(memory_bytes) {}

  /// Throws InputError, naming the source at hand, where lines and features so far take more than the memory until they
  /// are in the store.
  void require_room(const std::string& source) const;

  /// These functions take over a store's themes, then its lines, their vertices, and how they were imported: in this
  /// order. Of the sources of raised themes, those in `left_out` are left out, by number, and themes with no other.
  void take_themes(const StoreMetadata& metadata, const Sources& left_out);
  void take_segments(const Store& store);
  /// Takes a vertex over. Returns whether the vertex comes from lines, and so is taken over with them, not with the
  /// points. `of_terrain` tells that it belongs to the full surface.
  bool take_vertex(const GridPoint& p, std::uint16_t source, bool of_terrain);
  void take_set_aside(const StoreRows& rows);

  /// Takes over the footprints of raised themes, whose lines are made again instead, and the records of all features,
  /// but for those of sources in `left_out`. Returns how many features are left out.
  std::uint64_t take_features(const Store& store, const Sources& left_out);

  /// Returns the number of a theme, which is made if none has the name. Throws InputError where the theme that has it
  /// is of another kind, or is raised where the wanted one is not, or the other way round.
  std::uint32_t theme(const std::string& name, ThemeKind kind, bool raised);
  /// Sets the offset at which the walls of a raised theme reach their height. Throws InputError for an offset out of
  /// range, and for another one than the theme's footprints so far have.
  void offset_walls(std::uint32_t theme, double metres, const Grid& grid);
  /// Adds a line of a feature of the theme, given by its number, or of kNoFeature.
  void add(std::uint32_t theme, std::uint16_t source, std::uint32_t feature, std::span<const GridPoint> line);
  void count_features(std::uint32_t theme, std::uint64_t count) { themes_[theme].info.features += count; }

  /// The fields of a theme's features.
  std::vector<AttributeField>& fields(std::uint32_t theme) { return themes_[theme].features.fields; }
  /// Adds a feature to a theme of lines on the ground, its values in the order of fields(), and returns its number.
  std::uint32_t add_feature(std::uint32_t theme, std::uint16_t source, FeatureRecord record);
  /// Adds a footprint, with a record where its source keeps any.
  void add_footprint(std::uint32_t theme, StoredFootprint footprint, std::optional<FeatureRecord> record = {});
  /// Gives sources and features their numbers in the new store, once all are added: source s becomes `numbers[s]`, and
  /// features come in the order of their sources, and then as they were added. `sources` are the store's by their new
  /// numbers; their features are counted.
  void renumber(const std::vector<std::uint16_t>& numbers, std::vector<SourceInfo>& sources);
  /// Whether any theme is raised.
  bool is_raised() const;
  /// Builds all raised themes on a store's ground. Throws InputError where that takes more than the memory.
  void raise(const Store& ground, RaisedFeaturesReport& report, Progress& progress);

  /// Puts the themes in order and makes the lines of all of them planar. `ground` is as in raise(), if that was called.
  /// Lines as they were imported make room for `replacing`, which may be null, where their sources do. Lines of the
  /// terrain get vertices at those of the ground's points that they pass through.
  /// `points` may be null where no line lies on the ground.
  ThemeLines finish(const std::vector<SourceInfo>& sources, const Store* ground, const ReplacingGround* replacing,
                    const SortedPoints* points, Progress& progress);
  /// Tells after finish(), for lines as they lie on the ground, whether raised features have given lines of the terrain
  /// vertices that they do not have on that ground.
  bool changes_terrain(const ThemeLines& lines) const;
  /// Tells after finish() how many of the pieces in imported() made room, by source.
  const std::vector<std::uint64_t>& made_room() const { return made_room_; }
  /// All lines on the ground as they were imported, in order; known after finish().
  const std::vector<ImportedPiece>& imported() const { return imported_; }
  /// The themes in order, their features counted; known after finish().
  const std::vector<CollectedTheme>& themes() const { return themes_; }

 private:
  struct Vertex {
    std::int32_t z;
    std::uint16_t source;
  };
  struct OwnPart {
    std::uint32_t theme;
    RaisedPart part;
  };
  const ThemeInfo& theme_of(const Segment& s) const { return themes_[s.theme - std::size_t{1}].info; }
  std::uint16_t source_of_stored(const Segment& s) const;
  std::vector<std::uint32_t> features_of(const Segment& s) const;
  void add_lines(const std::vector<SourceInfo>& sources, const ReplacingGround* replacing);
  void find_first_sources(const std::vector<SourceInfo>& sources);
  void find_vertices(const std::vector<SourceInfo>& sources);
  void put_in_order(ThemeLines& result);
  void place_parts(ThemeLines& result);
  void keep(const OwnedSegment& ground_line);
  void keep_or_raise(const OwnedSegment& ground_line, const std::vector<MaskIndex>& masks);
  void make_lines(ThemeLines& result, const Store* ground, const Progress& progress);
  std::uint16_t source_of(const GridPoint& p, std::uint32_t owner) const;

  LinesAs as_;
  std::uint64_t memory_bytes_;
  std::uint64_t line_vertices_ = 0, feature_vertices_ = 0, record_bytes_ = 0;  ///< counts so far
  std::vector<CollectedTheme> themes_;
  std::vector<OwnPart> parts_;
  std::vector<std::string> theme_of_source_;               ///< by the store's source; empty for points
  std::vector<Segment> stored_;                            ///< the store's lines on the ground
  std::vector<SegmentFeature> stored_features_;            ///< the features of these lines, ascending
  std::unordered_map<std::uint64_t, std::uint32_t> ends_;  ///< themes by the codes of ends of stored terrain lines
  std::vector<ImportedPiece> imported_;
  std::vector<std::uint64_t> made_room_;
  std::vector<OwnedSegment> segments_;
  std::vector<ThemeVertex> ground_ends_;                ///< ends of edges that keep the ground about features
  std::unordered_map<std::uint64_t, Vertex> vertices_;  ///< vertices of the lines as they are taken, by Morton code
};

}  // namespace itin
