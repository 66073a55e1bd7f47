// A rule of radii as the document that read_radius_rule() reads.
#pragma once

#include <itin/document.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

Document radius_document(const RadiusRule& rule);

}  // namespace itin::viewshed
