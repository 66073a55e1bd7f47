// Positions in metres as places in grid units: those of libitin.
#pragma once

#include <itin/grid_units.hpp>
