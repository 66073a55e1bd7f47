#include "features/mesh/ground_border.hpp"

#include <algorithm>

#include "features/plan/planarity.hpp"

namespace itin {

namespace {

GridEdge undirected(const GridEdge& e) {
  return std::minmax(e.first, e.second);
}
GridEdge reversed(const GridEdge& e) {
  return {e.second, e.first};
}

}  // namespace

void ChangedGround::append(const ChangedGround& other) {
  pieces.insert(pieces.end(), other.pieces.begin(), other.pieces.end());
  inner.insert(inner.end(), other.inner.begin(), other.inner.end());
  border.insert(border.end(), other.border.begin(), other.border.end());
}

/// The lines that each border edge meets.
class GroundBorder::Contacts {
 public:
  struct Contact {
    std::uint32_t theme;
    GridEdge edge;                         ///< directed, as the theme has it
    std::vector<std::uint32_t> same, cut;  ///< lines along this very edge, and others that have a part in common
  };

  Contacts(const std::vector<OfTheme>& themes, const PlanarLines& lines) : lines_(lines) {
    for (std::uint32_t t = 0; t < themes.size(); ++t)
      for (const GridEdge& e : themes[t].border) contacts_.push_back({t, e, {}, {}});
    std::stable_sort(contacts_.begin(), contacts_.end(),
                     [](const Contact& a, const Contact& b) { return undirected(a.edge) < undirected(b.edge); });
    if (!contacts_.empty()) meet();
  }

  const std::vector<Contact>& all() const { return contacts_; }
  std::uint32_t owner(std::uint32_t line) const { return lines_.edges[line].owner; }
  std::set<LineOwner> owners_met(const Contact& contact, std::size_t themes) const {
    std::set<LineOwner> met;
    for (const std::vector<std::uint32_t>* const lines : {&contact.same, &contact.cut})
      for (const std::uint32_t line : *lines) add_owners(line, themes, met);
    return met;
  }

 private:
  void meet() {
    std::vector<GridEdge> edges;
    std::vector<std::size_t> first_line, first_border;  // by distinct edge, and one more behind the last
    for (std::size_t i = 0; i < lines_.edges.size(); ++i) {
      const GridEdge e = edge_of(lines_.edges[i]);
      if (!edges.empty() && edges.back() == e) continue;
      edges.push_back(e);
      first_line.push_back(i);
    }
    first_line.push_back(lines_.edges.size());
    const std::size_t of_lines = edges.size();
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const GridEdge e = undirected(contacts_[i].edge);
      if (i > 0 && edges.back() == e) continue;
      edges.push_back(e);
      first_border.push_back(i);
    }
    first_border.push_back(contacts_.size());
    for (const auto& [line, edge] : conflicts(edges)) {
      if (line >= of_lines || edge < of_lines) continue;
      const bool same = edges[line] == edges[edge];
      for (std::size_t b = first_border[edge - of_lines]; b < first_border[edge - of_lines + 1]; ++b) {
        std::vector<std::uint32_t>& met = same ? contacts_[b].same : contacts_[b].cut;
        for (std::size_t i = first_line[line]; i < first_line[line + 1]; ++i)
          met.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }

  void add_owners(std::uint32_t line, std::size_t themes, std::set<LineOwner>& owners) const {
    const std::uint32_t own = owner(line);
    auto feature = std::lower_bound(lines_.features.begin(), lines_.features.end(), EdgeFeature{line, 0});
    const bool clustered = own >= themes && feature != lines_.features.end() && feature->edge == line;
    if (!clustered) owners.insert({own});
    for (; clustered && feature != lines_.features.end() && feature->edge == line; ++feature)
      owners.insert({own, feature->feature});
  }

  GridEdge edge_of(const PlanarEdge& e) const {
    const GridPoint &a = lines_.vertices[e.from], &b = lines_.vertices[e.to];
    return std::minmax(Position{a.x, a.y}, Position{b.x, b.y});
  }

  const PlanarLines& lines_;
  std::vector<Contact> contacts_;
};

void GroundBorder::add(std::uint32_t theme, const ChangedGround& changed) {
  themes_[theme].inner.insert(changed.inner.begin(), changed.inner.end());
  themes_[theme].border.insert(changed.border.begin(), changed.border.end());
}

/// Makes a border edge an inner one and returns it as a line, at height 0, for heights come from the ground anyway.
OwnedSegment GroundBorder::keep(std::uint32_t theme, const GridEdge& edge) {
  themes_[theme].border.erase(edge);
  themes_[theme].border.erase(reversed(edge));
  themes_[theme].inner.insert(undirected(edge));
  return {{edge.first.x, edge.first.y, 0}, {edge.second.x, edge.second.y, 0}, theme};
}

std::vector<OwnedSegment> GroundBorder::seams() {
  std::vector<OwnedSegment> kept;
  for (std::uint32_t t = 0; t < themes_.size(); ++t) {
    OfTheme& of_theme = themes_[t];
    std::erase_if(of_theme.border, [&](const GridEdge& e) { return of_theme.inner.contains(undirected(e)); });
    std::vector<GridEdge> met;
    for (const GridEdge& e : of_theme.border)
      if (e.first < e.second && of_theme.border.contains(reversed(e))) met.push_back(e);
    for (const GridEdge& e : met) kept.push_back(keep(t, e));
  }
  return kept;
}

GroundBorder::Fit GroundBorder::fit(const PlanarLines& lines, const Owners& owners, const Apex& apex) {
  const Contacts contacts(themes_, lines);
  Fit result{widen(contacts, owners, apex), {}};
  if (result.lines.empty()) result.placed = place(contacts, owners);
  return result;
}

std::vector<OwnedSegment> GroundBorder::widen(const Contacts& contacts, const Owners& owners, const Apex& apex) {
  std::vector<OwnedSegment> kept;
  for (const Contacts::Contact& contact : contacts.all()) {
    const auto own = [&](std::uint32_t line) { return owners.theme[contacts.owner(line)] == contact.theme; };
    OfTheme& of_theme = themes_[contact.theme];
    if (std::none_of(contact.cut.begin(), contact.cut.end(), own) || !of_theme.border.contains(contact.edge)) continue;
    const auto& [from, to] = contact.edge;
    const std::optional<Position> beyond = apex(to, from);
    const OwnedSegment line = keep(contact.theme, contact.edge);
    if (!beyond) continue;  // the edge is part of the ground's outline, and a line in any case
    kept.push_back(line);
    for (const GridEdge& e : {GridEdge{from, *beyond}, GridEdge{*beyond, to}}) {
      if (of_theme.border.contains(reversed(e)))
        kept.push_back(keep(contact.theme, e));
      else if (!of_theme.inner.contains(undirected(e)))
        of_theme.border.insert(e);
    }
  }
  return kept;
}

std::vector<PlacedBorder> GroundBorder::place(const Contacts& contacts, const Owners& owners) const {
  std::vector<PlacedBorder> placed;
  for (const Contacts::Contact& contact : contacts.all()) {
    const std::set<LineOwner> met = contacts.owners_met(contact, themes_.size());
    const bool needless = std::any_of(met.begin(), met.end(), [&](const LineOwner& line) {
      return owners.theme[line.owner] == contact.theme || owners.terrain[owners.theme[line.owner]];
    });
    if (!needless) placed.push_back({{contact.theme, undirected(contact.edge)}, {met.begin(), met.end()}});
  }
  return placed;
}

}  // namespace itin
