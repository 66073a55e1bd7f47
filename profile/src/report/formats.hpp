// The report in each format, as bytes.
#pragma once

#include <string>
#include <vector>

#include <itin/vector_export.hpp>
#include <profile/los.hpp>

#include "drawing/drawing.hpp"

namespace itin::profile {

std::string report_csv(const LosReport& report);
std::string report_drawing(const LosReport& report, Drawing::Format format);
std::string report_html(const LosReport& report);
std::string report_kml(const LosReport& report);
std::vector<VectorLayer> report_layers(const LosReport& report);

}  // namespace itin::profile
