// Everything of libitin at once. Each of the headers below also stands on its own.
//
//   const Store store("wales.itin");
//   NoProgress progress;
//   const Tin tin = triangulate(store, Window::disc({318000, 176000}, 5000), Detail::tolerance(2), progress);
#pragma once

#include <itin/coordinates.hpp>
#include <itin/cross_section.hpp>
#include <itin/detail.hpp>
#include <itin/earth.hpp>
#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/geometry.hpp>
#include <itin/import.hpp>
#include <itin/network.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>
#include <itin/tin_export.hpp>
#include <itin/topology.hpp>
#include <itin/triangulate.hpp>
#include <itin/verify.hpp>
#include <itin/window.hpp>
