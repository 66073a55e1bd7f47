// A rule of radii as the document that read_radius_rule() reads, and in words.
#pragma once

#include <string>

#include <itin/document.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

Document radius_document(const RadiusRule& rule);

/// Describes the rule in one sentence. `of_proposal` tells whether it counts from proposed turbines alone.
std::string radius_text(const RadiusRule& rule, bool of_proposal);

}  // namespace itin::viewshed
