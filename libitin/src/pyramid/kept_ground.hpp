// The ground of a store, as it is, under other features than those that stand on it now.
#pragma once

#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "pyramid/pyramid.hpp"
#include "pyramid/theme_lines.hpp"
#include "store/store_writer.hpp"

namespace itin {

/// Whether features may come to a store and leave it, and its ground stays byte for byte: all lines that it has belong
/// to features that stand. Lines that lie on the ground share vertices with it, and features that cross them add more.
bool may_keep_ground(const StoreMetadata& metadata);

/// Writes the ground of `store`, and what build_pyramid() would write about `lines` over it: the same bytes. The
/// sources of points have the same numbers in `sources` as in the store. Precondition: may_keep_ground(), and no line
/// of `lines` lies on the ground. Throws CorruptStore, FileError, Cancelled.
PyramidReport keep_ground(const Store& store, const std::vector<SourceInfo>& sources, const ThemeLines& lines,
                          StoreWriter& writer, Progress& progress);

}  // namespace itin
