#include "window/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <itin/box_of.hpp>
#include <itin/call_progress.hpp>
#include <itin/certificate.hpp>
#include <itin/feature_cuts.hpp>
#include <itin/level_choice.hpp>
#include <itin/parallel.hpp>
#include <itin/raster.hpp>
#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>

#include "progress/stage.hpp"
#include "window/feature_bounds.hpp"

namespace itin::viewshed {

namespace {

constexpr std::size_t kVerticesPerChunk = 1 << 12;

void for_each_chunk(std::size_t count, const auto& body) {
  parallel_for((count + kVerticesPerChunk - 1) / kVerticesPerChunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kVerticesPerChunk; i < std::min(count, (chunk + 1) * kVerticesPerChunk); ++i) body(i);
  });
}

/// How far a level's surface lies above the full one at least and at most, grid units.
HeightBounds above_full(const Store& store, int level) {
  const StoreMetadata& metadata = store.metadata();
  const CertifiedError& error = metadata.levels[static_cast<std::size_t>(level)].certified_error;
  const auto units = [&](double metres) {
    return static_cast<std::int32_t>(std::ceil(metres / metadata.grid.resolution));
  };
  return {-units(error.hi), units(-error.lo)};
}

/// Each vertex gets the bounds over all its triangles.
std::vector<HeightBounds> vertex_bounds(const Store& store, int level, int surface, const Tin& tin,
                                        const ThemeChoice& cut_by) {
  std::vector<HeightBounds> result(tin.vertices.size());
  const std::vector<Certificate> cuts = feature_cuts(store, cut_by, tin.bounds());
  if (level == surface && cuts.empty()) return result;
  const Certificate certificate = level > surface ? store.certificate(level, tin.bounds()) : Certificate({});
  const HeightBounds wider = level > surface ? above_full(store, surface) : HeightBounds();
  std::vector<HeightBounds> of_triangle(tin.triangles.size());
  for_each_chunk(of_triangle.size(), [&](std::size_t t) {
    const GridBox box = box_of(tin.corners(t));
    if (const auto bounds = certificate.over(box)) of_triangle[t] = {bounds->lo + wider.lo, bounds->hi + wider.hi};
    of_triangle[t].lo -= deepest_cut(cuts, box);
  });
  constexpr auto kMax = std::numeric_limits<std::int32_t>::max(), kMin = std::numeric_limits<std::int32_t>::min();
  std::fill(result.begin(), result.end(), HeightBounds{kMax, kMin});
  for (std::size_t t = 0; t < of_triangle.size(); ++t) {
    for (const std::uint32_t v : tin.triangles[t]) {
      result[v].lo = std::min(result[v].lo, of_triangle[t].lo);
      result[v].hi = std::max(result[v].hi, of_triangle[t].hi);
    }
  }
  return result;
}

bool in_disc(const Tin& tin, const Triangle& t, const FineDisc& disc) {
  return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
    const Point3 p = tin.point(v);
    return std::hypot(p.x - disc.centre.x, p.y - disc.centre.y) < disc.radius;
  });
}

/// Which of many discs may hold a triangle.
class DiscIndex {
 public:
  explicit DiscIndex(const std::vector<FineDisc>& discs) : discs_(discs) {
    for (const FineDisc& disc : discs) all_.extend(box_of(disc));
    const double side = std::ceil(2 * std::sqrt(static_cast<double>(discs.size())));
    const double size = std::max({all_.width(), all_.height(), 1.0}) * 1.001 / side;
    bins_ = RasterGrid({all_.xmin, all_.ymax}, size, size, static_cast<std::int64_t>(side),
                       static_cast<std::int64_t>(side));
    of_bin_.resize(bins_.cell_count());
    for (std::uint32_t i = 0; i < discs.size(); ++i) {
      const Box box = box_of(discs[i]);
      const auto first = *bins_.cell_at({box.xmin, box.ymax}), last = *bins_.cell_at({box.xmax, box.ymin});
      for (std::int64_t row = first.row; row <= last.row; ++row)
        for (std::int64_t column = first.column; column <= last.column; ++column)
          of_bin_[bins_.index({column, row})].push_back(i);
    }
  }

  bool hold(const Tin& tin, const Triangle& t) const {
    const Point3 p = tin.point(t[0]);
    if (!all_.contains(Point2{p.x, p.y})) return false;  // most triangles are outside
    const auto bin = bins_.cell_at({p.x, p.y});
    if (!bin) return false;
    const std::vector<std::uint32_t>& near = of_bin_[bins_.index(*bin)];
    return std::any_of(near.begin(), near.end(), [&](std::uint32_t i) { return in_disc(tin, t, discs_[i]); });
  }

 private:
  static Box box_of(const FineDisc& disc) {
    return {disc.centre.x - disc.radius, disc.centre.y - disc.radius, disc.centre.x + disc.radius,
            disc.centre.y + disc.radius};
  }

  const std::vector<FineDisc>& discs_;
  Box all_;  ///< about all discs
  RasterGrid bins_;
  std::vector<std::vector<std::uint32_t>> of_bin_;
};

/// A level over a window, which replaces coarser levels within the discs.
struct WantedPiece {
  Window window;
  int level = 0;
  std::vector<FineDisc> discs;
};

struct Piece {
  Tin tin;
  std::vector<HeightBounds> bounds;  ///< one entry for each vertex
};

/// The level of the request, and each finer one about the discs that have it, the coarsest first.
std::vector<WantedPiece> wanted_pieces(const EnvelopeRequest& request) {
  std::vector<WantedPiece> wanted{{request.window, request.level, {}}};
  for (int level = request.level - 1; level >= 0; --level) {
    std::vector<FineDisc> discs;
    std::vector<Window::Polygon> parts;
    for (const FineDisc& disc : request.discs) {
      if (disc.level != level) continue;
      discs.push_back(disc);
      parts.push_back(Window::disc(disc.centre, disc.radius).parts().front());
    }
    if (!discs.empty()) wanted.push_back({Window::polygons(std::move(parts)), level, std::move(discs)});
  }
  return wanted;
}

/// Retrieves all pieces at once, since each of them alone hardly keeps the threads at work.
std::vector<Piece> retrieve_pieces(const Store& store, const std::vector<WantedPiece>& wanted,
                                   const EnvelopeRequest& request, Progress& progress) {
  std::vector<Piece> pieces(wanted.size());
  for_each_step(wanted.size(), "triangulating", progress, [&](std::size_t i) {
    SilentProgress silent(progress);
    pieces[i].tin =
        triangulate(store, wanted[i].window, detail_of(store.metadata(), wanted[i].level), silent, request.themes);
    pieces[i].bounds = vertex_bounds(store, wanted[i].level, request.surface, pieces[i].tin, request.cut_by);
    if (request.enclosed.includes_raised(store.metadata().themes))
      enclose_features(store, request.enclosed, pieces[i].tin, pieces[i].bounds);
  });
  return pieces;
}

class Builder {
 public:
  void add(const Piece& of) {
    const Tin& piece = of.tin;
    const std::vector<HeightBounds>& bounds = of.bounds;
    const auto first = static_cast<std::uint32_t>(lower_.vertices.size());
    lower_.grid = piece.grid;
    const std::size_t first_triangle = lower_.triangles.size();
    lower_.statistics += piece.statistics;
    lower_.vertices.resize(first + piece.vertices.size()), upper_.resize(lower_.vertices.size());
    for_each_chunk(piece.vertices.size(), [&](std::size_t v) {
      const GridPoint& p = piece.vertices[v];
      lower_.vertices[first + v] = {p.x, p.y, p.z + bounds[v].lo};
      upper_[first + v] = p.z + bounds[v].hi;
    });
    lower_.triangles.resize(first_triangle + piece.triangles.size());
    for_each_chunk(piece.triangles.size(), [&](std::size_t i) {
      const Triangle& t = piece.triangles[i];
      lower_.triangles[first_triangle + i] = {t[0] + first, t[1] + first, t[2] + first};
    });
  }

  void mark_outline() { outline_ = boundary_edges(lower_); }

  /// Leaves out triangles that lie within a disc, except at the outline.
  void clear(const std::vector<FineDisc>& discs) {
    const DiscIndex index(discs);
    std::vector<std::uint8_t> drop(lower_.triangles.size());
    for_each_chunk(drop.size(), [&](std::size_t t) { drop[t] = index.hold(lower_, lower_.triangles[t]); });
    for (const BoundaryEdge& edge : outline_) drop[edge.triangle] = 0;
    std::vector<std::uint32_t> number(drop.size());
    std::uint32_t kept = 0;
    for (std::size_t t = 0; t < drop.size(); ++t) {
      number[t] = kept;
      if (!drop[t]) lower_.triangles[kept++] = lower_.triangles[t];
    }
    lower_.triangles.resize(kept);
    for (BoundaryEdge& edge : outline_) edge.triangle = number[edge.triangle];
  }

  Envelope finish() && {
    Envelope envelope;
    lower_.sources.assign(lower_.vertices.size(), 0);
    envelope.upper = lower_;
    for (std::size_t v = 0; v < upper_.size(); ++v) envelope.upper.vertices[v].z = upper_[v];
    envelope.lower = std::move(lower_);
    envelope.outline = std::move(outline_);
    return envelope;
  }

 private:
  Tin lower_;
  std::vector<std::int32_t> upper_;  ///< heights
  std::vector<BoundaryEdge> outline_;
};

}  // namespace

Envelope envelop(const Store& store, const EnvelopeRequest& request, Progress& progress) {
  CallProgress call(progress);
  const std::vector<WantedPiece> wanted = wanted_pieces(request);
  std::vector<Piece> pieces = retrieve_pieces(store, wanted, request, call.step(request.bare_ground ? 0.5 : 1));
  Builder builder;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (i > 0) builder.clear(wanted[i].discs);
    builder.add(std::exchange(pieces[i], {}));
    if (i == 0) builder.mark_outline();
  }
  Envelope envelope = std::move(builder).finish();
  envelope.exact = request.level == request.surface && !request.enclosed.includes_raised(store.metadata().themes) &&
                   feature_cuts(store, request.cut_by, envelope.lower.bounds()).empty();
  if (request.bare_ground) {
    envelope.bare_ground = triangulate(store, *request.bare_ground, Detail::tolerance(0), call.step(1));
    envelope.lower.statistics += envelope.bare_ground->statistics;
  }
  call.finish();
  return envelope;
}

}  // namespace itin::viewshed
