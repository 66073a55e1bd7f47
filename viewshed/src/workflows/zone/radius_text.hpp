// A rule of radii in words.
#pragma once

#include <string>

#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// Describes the rule in one sentence.
std::string radius_text(const RadiusRule& rule);

}  // namespace itin::viewshed
