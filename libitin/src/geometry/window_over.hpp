// The window that boxes cover together.
#pragma once

#include <utility>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/window.hpp>

namespace itin {

/// Boxes may overlap, and may have no area.
inline Window window_over(const std::vector<Box>& boxes) {
  std::vector<Window::Polygon> parts;
  for (const Box& box : boxes) parts.push_back(Window::rectangle(box));
  return Window::polygons(std::move(parts));
}

}  // namespace itin
