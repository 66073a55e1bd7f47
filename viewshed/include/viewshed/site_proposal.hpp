// Candidates for sites, proposed from the terrain after Franklin and Vogt (2006): the most visible places, spaced.
//
//   const Window area = Window::box({304000, 181000, 336000, 206000});
//   for (const viewshed::Proposal& p : viewshed::propose_sites(store, area, {.spacing = 1000}, progress))
//     std::cout << p.position.x << ' ' << p.position.y << '\n';
//
// The area is cut into squares of the spacing. Each proposes its highest post, if that is a summit (no neighbour nearby
// is higher), and the post of the greatest visibility index: the share that it sees of a few targets at random
// distances and azimuths. What stands on the ground hides; where sites may stand on it, roofs of buildings take part as
// posts do, in their middle, and the highest roof of a square as a summit does.
#pragma once

#include <vector>

#include <itin/earth.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/window.hpp>

namespace itin::viewshed {

struct ProposalRequest {
  double spacing = 1000;  ///< metres
  double radius = 10000;
  double mast_height = 20;
  double target_height = 2;
  Earth earth = {};
  ThemeChoice themes = ThemeChoice::none();  ///< what stands on the ground
  bool on_surface = false;                   ///< on roofs of these as well, at least three metres high
  bool targets_on_surface = false;           ///< targets stand on these themes, too
};

struct Proposal {
  Point2 position;
  bool summit = false;          ///< or the highest roof
  bool roof = false;            ///< stands on a building
  double visibility_index = 0;  ///< 0 to 1
};

/// Returns the sites in order of their squares, from the north-west. Equal stores and requests give equal sites. Throws
/// InputError if no ground lies in the area, or it has too many squares.
std::vector<Proposal> propose_sites(const Store& store, const Window& area, const ProposalRequest& request,
                                    Progress& progress);

}  // namespace itin::viewshed
