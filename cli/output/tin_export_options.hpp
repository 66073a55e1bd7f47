// What files of triangles, lines and topologies say besides their geometry.
#pragma once

#include <itin/document.hpp>
#include <itin/store.hpp>
#include <itin/tin_export.hpp>

namespace itin::cli {

/// `origin` says where the triangles come from, beside the version of this program.
TinExportOptions tin_export_options(const StoreMetadata& metadata, const Document& origin, bool overwrite);

}  // namespace itin::cli
