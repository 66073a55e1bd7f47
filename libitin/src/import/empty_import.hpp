// Finds out why an import would add nothing.
#pragma once

#include <itin/import.hpp>

namespace itin {

/// Throws InputError where filters left nothing of what was read, or where nothing had a height. If `may_be_void`,
/// warns instead where nothing had a height.
void require_points(ImportReport& report, const ImportOptions& options, bool may_be_void);

/// Throws InputError for a store without vertices, where no three points span ground.
void require_ground(const ImportReport& report, const ImportOptions& options);

}  // namespace itin
