// A multiscale implicit TIN on disk, open for reading.
//
//   const Store store("wales.itin");
//   for (const LevelInfo& level : store.metadata().levels) std::cout << level.tolerance << " m\n";
//
// A Store is safe to use from any number of threads. Blocks are decoded once and kept in a cache shared by all
// threads, bounded by StoreOptions::cache_bytes. No triangle is stored; see triangulate.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <itin/coordinates.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/theme.hpp>

namespace itin {

// These are declared in headers that are not installed.
class Certificate;
class PointIndex;
class StoreFile;
struct StoredFootprint;

/// The bounds of a level's error: T_k + lo <= T_0 <= T_k + hi, metres.
struct CertifiedError {
  double lo = 0;
  double hi = 0;
};

struct LevelInfo {
  double tolerance = 0;          ///< metres; 0 for level 0, which holds everything
  double lateral_tolerance = 0;  ///< metres, for lines
  std::uint64_t vertices = 0;    ///< vertices whose coarsest level this is
  CertifiedError certified_error;
};

/// One imported file.
struct SourceInfo {
  std::string path;            ///< the file's name, without folders
  std::string kind;            ///< "terrain", or a theme's kind (theme.hpp)
  std::string theme;           ///< name of the theme; empty for terrain
  std::string imported;        ///< UTC, ISO 8601
  std::string sha256;          ///< checksum of the file's bytes; empty where the source is not a plain file
  std::string source_crs;      ///< as found or given, authority:code or WKT
  std::uint64_t vertices = 0;  ///< vertices that came from the file and are still there
  /// Gaps up to these two vectors u, v (metres, projected) are triangulated as ground. For a raster, they are 1.5 times
  /// the two lattice steps (a missing post leaves a hole); for scattered points with max-gap G, (G, 0) and (0, G). An
  /// edge e = a u + b v between two vertices may be ground when |a| <= 1 and |b| <= 1 for either vertex's source.
  std::array<double, 4> gap_basis{};  ///< ux, uy, vx, vy
  double spacing = 0;                 ///< metres: lattice step (geometric mean of the two), or mean point spacing
  bool replaces = false;              ///< took the place of coarser ground
  bool makes_room = false;            ///< its lines end at the border of ground that replaces others
  std::string note;                   ///< product, date and licence, as the import or the file says; may be empty
  /// How many features with a number the source has given its theme, and the fields that it has for them. A theme's
  /// features are numbered in the order of its sources.
  std::uint64_t features = 0;
  std::vector<AttributeField> fields = {};
  std::optional<double> wall_offset = {};  ///< metres, where its import said so; see ThemeInfo::wall_offset
  std::string heights_from = {};  ///< the raster that gave its features heights: name and checksum; empty: none
  bool states_heights = true;     ///< false: all heights of its features are of that raster
};

struct StoreMetadata {
  int format_version = 0;
  std::string crs_wkt;
  Grid grid;
  GridBox bounds;                  ///< the box about all vertices
  std::optional<GridScale> scale;  ///< over the bounds; nothing where the CRS does not tell, and in older stores
  std::vector<LevelInfo> levels;   ///< level 0 (tolerance 0) first, then coarser and coarser
  int fine_levels = 1;  ///< the first level whose vertices are stored a second time, to be read by themselves
  /// So many levels after level 0 have right triangles about the posts of rasters, and need more vertices for it than
  /// others. Nothing in older stores.
  std::optional<int> right_triangle_levels;
  std::vector<SourceInfo> sources;  ///< those of points first; the order knows none of import
  std::vector<ThemeInfo> themes;    ///< the themes of the terrain first, then by name
  std::vector<ThemePart> parts;     ///< the parts of raised themes, in the themes' order, then the finest first
  bool has_foundations = false;     ///< some buildings stand on flat foundations, which may cut into the ground
  std::uint64_t vertices = 0;
};

struct StoreOptions {
  // Options change the speed, never the answer.
  std::uint64_t cache_bytes = std::uint64_t{256} << 20;
};

/// One damaged place.
struct Damage {
  std::string place;  ///< for example "block 3/0000000041c00"
  std::string what;
};

class Store {
 public:
  /// Throws FileError (missing, unreadable), StoreFormatError (foreign, too new), CorruptStore (damaged).
  explicit Store(const std::string& path, const StoreOptions& options = {});
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  const std::string& path() const;
  const StoreMetadata& metadata() const;
  std::uint64_t file_bytes() const;
  /// Returns the widest bounds of the level's cells that meet the box: T_level + lo <= T_0 <= T_level + hi all over it.
  /// Nullopt where there is no ground. Throws InputError for a level the store does not have, CorruptStore.
  std::optional<CertifiedError> certified_error(int level, const Box& box) const;
  /// Returns the most, metres, by which features of the chosen themes rise above T_0 under them in the cells that meet
  /// the box; 0 where there are no features. Throws CorruptStore.
  double greatest_feature_height(const ThemeChoice& themes, const Box& box) const;
  /// Returns the same height for those features alone that a query at `level` leaves out.
  double greatest_height_left_out(const ThemeChoice& themes, int level, const Box& box) const;
  /// Estimates how many points of this level and coarser lie in the box; reads none. Throws as certified_error() does.
  std::uint64_t points_about(int level, const Box& box) const;

  // The following functions serve the libraries of this toolkit.
  /// The quadtrees of the stored points.
  const PointIndex& points() const;
  /// Returns the bounds of the level's cells that meet the box, for questions about many places. Throws as
  /// certified_error() does.
  Certificate certificate(int level, const Box& box) const;

 private:
  friend std::vector<Damage> check(const Store& store, Progress& progress);
  friend std::vector<StoredFootprint> stored_footprints(const Store& store, std::uint16_t theme, std::uint32_t block);
  std::unique_ptr<StoreFile> file_;
};

/// Reads every byte of the store and verifies checksums, index, order and counts, and that certificates are present
/// wherever there is ground. Whether certificates are also true is for verify() to find out (verify.hpp). Returns an
/// empty vector for a sound store. Throws FileError when reading itself fails, and Cancelled.
std::vector<Damage> check(const Store& store, Progress& progress);

/// Returns 32 hexadecimal digits that tell what the store holds: XXH3-128 over every row and over the metadata but for
/// the times of the imports. Stores that were made from the same sources with the same options have the same digest,
/// whatever the machine, the compiler, the number of threads, and the order of imports, as long as the first one makes
/// the same choices (CRS, grid, levels). Reads every byte. Throws CorruptStore, FileError, Cancelled.
std::string content_digest(const Store& store, Progress& progress);

}  // namespace itin
