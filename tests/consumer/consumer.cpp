// A first program of a user of the installed package: it compiles, links and runs without a store at hand.
#include <cstdlib>

#include <itin/detail.hpp>
#include <itin/error.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>
#include <itin/window.hpp>
#include <viewshed/map_image.hpp>

int main() {
  // The module that draws is found beside the libraries.
  const itin::viewshed::MapImage image{2, 1, {255, 0, 0, 0, 0, 255}};
  itin::viewshed::write_image("map.png", image, true);
  try {
    const itin::Store store("no such store.itin");
    itin::NoProgress progress;
    const itin::Window window = itin::Window::disc({318000, 176000}, 5000);
    return static_cast<int>(itin::triangulate(store, window, itin::Detail::tolerance(2), progress).triangles.size());
  } catch (const itin::FileError&) {
    return EXIT_SUCCESS;
  }
}
