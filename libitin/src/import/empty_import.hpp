// Why an import would add nothing.
#pragma once

#include <itin/import.hpp>

namespace itin {

/// Throws InputError where filters left nothing of what was read, or, unless `may_be_void`, where nothing had a height;
/// warns where nothing had one.
void require_points(ImportReport& report, const ImportOptions& options, bool may_be_void);

/// Throws InputError for a store without vertices: no three of its points span ground.
void require_ground(const ImportReport& report, const ImportOptions& options);

}  // namespace itin
