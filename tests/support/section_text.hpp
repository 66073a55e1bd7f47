// Cross-sections to compare: as text, and seen from the other end.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>

#include <itin/cross_section.hpp>

namespace itin::test {

inline std::string text(const CrossSection& section) {
  std::ostringstream out;
  out.precision(17);
  for (const Breakpoint& b : section.breakpoints) {
    out << b.distance << ": " << b.position.x << " " << b.position.y << " " << b.position.z << " " << b.theme << "\n";
  }
  for (const SectionGap& g : section.gaps) out << "gap " << g.from << " " << g.to << "\n";
  return out.str();
}

inline CrossSection mirrored(CrossSection s) {
  std::reverse(s.breakpoints.begin(), s.breakpoints.end());
  std::reverse(s.gaps.begin(), s.gaps.end());
  for (Breakpoint& b : s.breakpoints) b.distance = s.length - b.distance;
  for (SectionGap& g : s.gaps) g = {s.length - g.to, s.length - g.from};
  return s;
}

}  // namespace itin::test
