#include "triangulate/region/right_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <itin/box_of.hpp>

#include "geometry/predicates.hpp"
#include "geometry/whole_division.hpp"
#include "triangulate/region/region_reader.hpp"

namespace itin {

namespace {

/// Bounds the places of a lattice. Levels that keep fewer of its posts are not closed.
constexpr std::int64_t kMostPlacesPerPost = 8;
/// Runs of successive positions vote for the lattice: so many runs, each with so many positions.
constexpr std::size_t kVoters = 16, kPositionsOfVoter = 256;

/// Returns the lattice that most of some runs of positions lie on.
std::optional<PostLattice> lattice_of(std::span<const Position> positions) {
  std::map<PostLattice, int> votes;
  for (std::size_t i = 0; i < kVoters; ++i) {
    const std::size_t first = i * positions.size() / kVoters;
    WidestLattice widest;
    for (const Position& p : positions.subspan(first, std::min(kPositionsOfVoter, positions.size() - first)))
      widest.add(p.x, p.y);
    votes[widest.lattice().from_first_place()] += 1;
  }
  const auto most =
      std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most->first.step_x == most->first.step_y ? std::optional(most->first) : std::nullopt;
}

}  // namespace

RightTriangles::RightTriangles(std::span<const Position> positions, std::span<const Segment> segments,
                               const GridBox& known) {
  posts_.resize(positions.size());
  if (place(positions)) {
    find_bare_squares(positions, segments, known);
    for (std::int32_t row = 0; row < up_; row += kBlockSide)
      for (std::int32_t column = 0; column < across_; column += kBlockSide) find_closed({column, row, kBlockSide});
    count_open_squares();
    for (const Square& square : closed_) {
      for (const Face& half : halves_of(square)) list(half, square);
    }
    note_edges();
    break_ties();
  }
  find_rest();
}

/// Places the positions on a lattice. Returns false when they form none.
bool RightTriangles::place(std::span<const Position> positions) {
  if (positions.size() < kPositionsOfVoter) return false;
  const auto lattice = lattice_of(positions);
  if (!lattice) return false;
  lattice_ = *lattice;
  const GridBox box = box_of(positions, [](const Position& p) { return p; });
  const std::int64_t side = kBlockSide * lattice_.step_x;
  const std::int64_t west = floor_divide(box.xmin - lattice_.x, side),
                     south = floor_divide(box.ymin - lattice_.y, side);
  const std::int64_t across = (floor_divide(box.xmax - lattice_.x, side) + 1 - west) * kBlockSide,
                     up = (floor_divide(box.ymax - lattice_.y, side) + 1 - south) * kBlockSide;
  if (across * up > kMostPlacesPerPost * static_cast<std::int64_t>(positions.size()) + 4 * kBlockSide * kBlockSide)
    return false;
  across_ = static_cast<std::int32_t>(across), up_ = static_cast<std::int32_t>(up);
  lattice_.x += west * side, lattice_.y += south * side;
  vertices_.assign(static_cast<std::size_t>((across + 1) * (up + 1)), kNone);
  // A multiplication is quicker than a division. The factor is a little too great, so that none is rounded down.
  const double per_unit = (1 + 1e-12) / static_cast<double>(lattice_.step_x);
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const std::int64_t x = positions[i].x - lattice_.x, y = positions[i].y - lattice_.y;
    const Post at{static_cast<std::int32_t>(static_cast<double>(x) * per_unit),
                  static_cast<std::int32_t>(static_cast<double>(y) * per_unit)};
    if (at.column * lattice_.step_x != x || at.row * lattice_.step_x != y) continue;
    posts_[i] = at;
    vertices_[post(at)] = i;
  }
  return true;
}

void RightTriangles::find_bare_squares(std::span<const Position> positions, std::span<const Segment> segments,
                                       const GridBox& known) {
  bare_.assign(static_cast<std::size_t>(across_) * static_cast<std::size_t>(up_), 1);
  const auto is_known = [&](std::int32_t column, std::int32_t row) {
    return known.contains(box_of_square(column, row));
  };
  for (std::int32_t row = 0; row < up_; ++row) {
    std::int32_t west = 0, east = across_;
    while (west < east && !is_known(west, row)) ++west;
    while (east > west && !is_known(east - 1, row)) --east;
    std::fill_n(bare_.begin() + static_cast<std::ptrdiff_t>(square(0, row)), west, std::uint8_t{0});
    std::fill_n(bare_.begin() + static_cast<std::ptrdiff_t>(square(east, row)), across_ - east, std::uint8_t{0});
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Position p = positions[i];
    if (posts_[i] == Post{}) spoil({p.x, p.y, p.x, p.y}, [](const GridBox&) { return true; });
  }
  const GridBox all = box_of(positions, [](const Position& p) { return p; });
  for (const Segment& s : segments) {
    const GridBox box = extent_of(s);
    // Beyond the outermost posts there is nothing that a segment could hide.
    const bool outermost = (box.xmin == box.xmax && (box.xmin <= all.xmin || box.xmax >= all.xmax)) ||
                           (box.ymin == box.ymax && (box.ymin <= all.ymin || box.ymax >= all.ymax));
    if (s.theme == kCoverage && outermost) continue;
    spoil(box, [&](const GridBox& square) { return meets(s.a(), s.b(), square); });
  }
}

/// Marks the single squares at the box for which met(square) holds: something is there that is no post.
template <class Met>
void RightTriangles::spoil(const GridBox& box, const Met& met) {
  const std::int64_t step = lattice_.step_x;
  const auto low = [&](std::int64_t v) { return std::max<std::int64_t>(ceil_divide(v, step) - 1, 0); };
  const auto high = [&](std::int64_t v, std::int32_t count) {
    return std::min<std::int64_t>(floor_divide(v, step), count - 1);
  };
  for (std::int64_t row = low(box.ymin - lattice_.y); row <= high(box.ymax - lattice_.y, up_); ++row) {
    for (std::int64_t column = low(box.xmin - lattice_.x); column <= high(box.xmax - lattice_.x, across_); ++column) {
      const auto c = static_cast<std::int32_t>(column), r = static_cast<std::int32_t>(row);
      if (met(box_of_square(c, r))) bare_[square(c, r)] = 0;
    }
  }
}

/// The right triangles of a level square.
std::array<RightTriangles::Face, 2> RightTriangles::halves_of(const Square& square) {
  const auto& [column, row, side] = square;
  const Post sw{column, row}, se{column + side, row}, ne{column + side, row + side}, nw{column, row + side};
  return {{{sw, se, nw}, {ne, nw, se}}};
}

/// Notes a square whose posts are closed, or those of its quarters.
void RightTriangles::find_closed(const Square& square) {
  if (is_closed(square)) {
    closed_.push_back(square);
    return;
  }
  const std::int32_t half = square.side / 2;
  if (half == 0) return;
  for (const std::int32_t row : {square.row, square.row + half})
    for (const std::int32_t column : {square.column, square.column + half}) find_closed({column, row, half});
}

/// Tells whether nothing but posts is in a square, and every post but the corners is in the middle of two triangles
/// that it halves, or of one at the square's side.
bool RightTriangles::is_closed(const Square& s) const {
  const auto halves = halves_of(s);
  for (const Face& half : halves)
    if (!has(half[0]) || !has(half[1])) return false;
  std::size_t posts = 0;
  for (std::int32_t row = s.row; row < s.row + s.side; ++row) {
    const auto first = bare_.begin() + static_cast<std::ptrdiff_t>(square(s.column, row));
    if (std::find(first, first + s.side, 0) != first + s.side) return false;
  }
  for (std::int32_t row = s.row; row <= s.row + s.side; ++row) {
    const auto first = vertices_.begin() + static_cast<std::ptrdiff_t>(post({s.column, row}));
    posts += static_cast<std::size_t>(s.side + 1 - std::count(first, first + s.side + 1, kNone));
  }
  return halvings(halves[0], s) + halvings(halves[1], s) + 8 == 2 * posts;
}

/// The post that halves a triangle, if it is there.
std::optional<RightTriangles::Post> RightTriangles::halver(const Face& face) const {
  const std::int32_t columns = face[1].column + face[2].column, rows = face[1].row + face[2].row;
  const Post middle{columns / 2, rows / 2};
  return ((columns | rows) & 1) == 0 && has(middle) ? std::optional(middle) : std::nullopt;
}

/// Returns how often posts halve a triangle and its parts; twice for each that does so at the square's side.
std::size_t RightTriangles::halvings(const Face& face, const Square& square) const {
  const auto middle = halver(face);
  if (!middle) return 0;
  const bool at_side = middle->column == square.column || middle->column == square.column + square.side ||
                       middle->row == square.row || middle->row == square.row + square.side;
  return (at_side ? 2 : 1) + halvings({*middle, face[2], face[0]}, square) +
         halvings({*middle, face[0], face[1]}, square);
}

void RightTriangles::count_open_squares() {
  std::vector<std::uint8_t> closed(bare_.size(), 0);
  for (const Square& s : closed_) {
    for (std::int32_t row = s.row; row < s.row + s.side; ++row)
      std::fill_n(closed.begin() + static_cast<std::ptrdiff_t>(square(s.column, row)), s.side, std::uint8_t{1});
  }
  open_ = {across_, up_, [&](std::int64_t column, std::int64_t row) {
             return closed[square(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row))] == 0;
           }};
}

/// Lists the parts of a triangle whose circles stay within closed squares.
void RightTriangles::list(const Face& face, const Square& square) {
  if (const auto middle = halver(face)) {
    list({*middle, face[2], face[0]}, square);
    list({*middle, face[0], face[1]}, square);
  } else if (has_known_circle(face, square)) {
    faces_.push_back(face);
  }
}

bool RightTriangles::has_known_circle(const Face& face, const Square& s) const {
  const auto& [apex, from, to] = face;
  const std::int32_t across = std::abs(to.column - from.column), up = std::abs(to.row - from.row);
  // The diameter is the side opposite the right angle: level, plumb, or a diagonal, at most 1.418 times as long as
  // wide.
  const std::int32_t diameter = across == 0 || up == 0 ? across + up : across + (across * 107 + 255) / 256;
  const std::int32_t columns = from.column + to.column, rows = from.row + to.row;
  const std::int32_t west = floor_divide(columns - diameter, 2), east = ceil_divide(columns + diameter, 2),
                     south = floor_divide(rows - diameter, 2), north = ceil_divide(rows + diameter, 2);
  if (west >= s.column && south >= s.row && east <= s.column + s.side && north <= s.row + s.side) return true;
  return !open_.any_in(west, east, south, north);
}

/// Notes which faces lie left of their edges.
void RightTriangles::note_edges() {
  left_of_.assign(faces_.empty() ? 0 : posts_.size() * kDirections, kNone);
  for (std::uint32_t f = 0; f < faces_.size(); ++f) note_edges(f);
}

void RightTriangles::note_edges(std::uint32_t face) {
  for (std::size_t i = 0; i < 3; ++i) left_of_[edge(faces_[face][i], faces_[face][(i + 1) % 3])] = face;
}

/// Where both halves of a square are faces, four vertices are on their circle, and the tie rule chooses the diagonal.
void RightTriangles::break_ties() {
  const bool level_is_wrong = in_circle_perturbed(Position{1, 2}, Position{0, 1}, Position{2, 1}, Position{1, 0}) > 0,
             plumb_is_wrong = in_circle_perturbed(Position{2, 1}, Position{1, 2}, Position{1, 0}, Position{0, 1}) > 0,
             rising_is_wrong = in_circle_perturbed(Position{0, 1}, Position{0, 0}, Position{1, 1}, Position{1, 0}) > 0,
             falling_is_wrong = in_circle_perturbed(Position{1, 1}, Position{0, 1}, Position{1, 0}, Position{0, 0}) > 0;
  const auto is_wrong = [&](const Post& from, const Post& to) {
    if (from.row == to.row) return level_is_wrong;
    if (from.column == to.column) return plumb_is_wrong;
    return (from.column < to.column) == (from.row < to.row) ? rising_is_wrong : falling_is_wrong;
  };
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    const auto [apex, from, to] = faces_[f];
    if (!is_wrong(from, to)) continue;
    const std::uint32_t beyond = left_of_[edge(to, from)];
    if (beyond == kNone || beyond < f || faces_[beyond][1] != to || faces_[beyond][2] != from) continue;
    const Post opposite = faces_[beyond][0];
    left_of_[edge(to, from)] = left_of_[edge(from, to)] = kNone;
    faces_[f] = {from, opposite, apex};
    faces_[beyond] = {to, apex, opposite};
    note_edges(f), note_edges(beyond);
  }
}

/// A position belongs to no other triangles where the angles of its faces, in eighths of a turn, fill the turn.
void RightTriangles::find_rest() {
  std::vector<std::uint8_t> angles(posts_.size(), 0);
  for (const Face& face : faces_)
    for (std::size_t i = 0; i < 3; ++i) angles[vertex(face[i])] += i == 0 ? 2 : 1;
  for (std::uint32_t i = 0; i < angles.size(); ++i)
    if (angles[i] != kDirections) rest_.push_back(i);
}

GridBox RightTriangles::box_of_square(std::int32_t column, std::int32_t row) const {
  const auto inside = [](std::int64_t v) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(v, std::numeric_limits<std::int32_t>::min(),
                                                              std::numeric_limits<std::int32_t>::max()));
  };
  const std::int64_t west = lattice_.x + column * lattice_.step_x, south = lattice_.y + row * lattice_.step_y;
  return {inside(west), inside(south), inside(west + lattice_.step_x), inside(south + lattice_.step_y)};
}

/// The place of an edge in left_of_.
std::size_t RightTriangles::edge(const Post& from, const Post& to) const {
  const int across = (to.column > from.column) - (to.column < from.column),
            up = (to.row > from.row) - (to.row < from.row);
  const int towards = 3 * up + across;
  return vertex(from) * kDirections + static_cast<std::size_t>(towards > 0 ? towards + 3 : towards + 4);
}

/// The face that has the edge between these vertices, counterclockwise; kNone where there is none.
std::uint32_t RightTriangles::face_left_of(std::uint32_t from, std::uint32_t to) const {
  if (from >= posts_.size() || to >= posts_.size() || posts_[from] == Post{} || posts_[to] == Post{}) return kNone;
  const std::uint32_t face = left_of_[edge(posts_[from], posts_[to])];
  if (face == kNone) return kNone;
  const Face& corners = faces_[face];
  const auto start = std::find(corners.begin(), corners.end(), posts_[from]);
  return start != corners.end() && corners[static_cast<std::size_t>(start - corners.begin() + 1) % 3] == posts_[to]
             ? face
             : kNone;
}

void RightTriangles::fill(PlaneMesh& mesh) const {
  if (faces_.empty()) return;
  const std::vector<std::uint8_t> covered = covered_by_faces(mesh);
  std::vector<std::uint32_t> numbers(mesh.triangles.size(), kNone);
  PlaneMesh all;
  all.triangles.reserve(faces_.size() + mesh.triangles.size());
  all.neighbours.reserve(faces_.size() + mesh.triangles.size());
  for (const Face& face : faces_) {
    Triangle corners{}, neighbours{};
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = vertex(face[i]);
      neighbours[i] = left_of_[edge(face[(i + 2) % 3], face[(i + 1) % 3])];
    }
    all.triangles.push_back(corners);
    all.neighbours.push_back(neighbours);
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (covered[t] != 0) continue;
    numbers[t] = static_cast<std::uint32_t>(all.triangles.size());
    all.triangles.push_back(mesh.triangles[t]);
    all.neighbours.push_back(mesh.neighbours[t]);
  }
  for (auto t = static_cast<std::uint32_t>(faces_.size()); t < all.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& neighbour = all.neighbours[t][i];
      if (neighbour == kNone) continue;
      neighbour = numbers[neighbour];
      if (neighbour != kNone) continue;
      const std::uint32_t from = all.triangles[t][(i + 1) % 3], to = all.triangles[t][(i + 2) % 3];
      neighbour = face_left_of(to, from);
      const auto& corners = all.triangles[neighbour];
      // The face's edge is opposite the corner that is no end of it.
      for (std::size_t j = 0; j < 3; ++j)
        if (corners[j] != from && corners[j] != to) all.neighbours[neighbour][j] = t;
    }
  }
  mesh = std::move(all);
}

/// Tells which triangles of the rest's triangulation lie where faces are. The faces' border is made of its edges.
std::vector<std::uint8_t> RightTriangles::covered_by_faces(const PlaneMesh& mesh) const {
  std::vector<std::uint8_t> covered(mesh.triangles.size(), 0);
  std::vector<std::uint32_t> open;
  const auto cover = [&](std::uint32_t t) {
    if (covered[t] == 0) covered[t] = 1, open.push_back(t);
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    for (std::size_t i = 0; i < 3; ++i)
      if (face_left_of(v[(i + 1) % 3], v[(i + 2) % 3]) != kNone) cover(t);
  }
  while (!open.empty()) {
    const std::uint32_t t = open.back();
    open.pop_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = mesh.triangles[t][(i + 1) % 3], to = mesh.triangles[t][(i + 2) % 3];
      const bool border = face_left_of(from, to) != kNone && face_left_of(to, from) == kNone;
      if (!border && mesh.neighbours[t][i] != kNone) cover(mesh.neighbours[t][i]);
    }
  }
  return covered;
}

}  // namespace itin
