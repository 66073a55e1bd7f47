// Text that OpenImageIO 2.4 can draw: it takes UTF-8 but keeps only the last six bits of each letter beyond ASCII.
#pragma once

#include <string>
#include <string_view>

namespace itin::viewshed {

/// Latin letters lose their accents, a few signs are written out, anything else beyond ASCII becomes '?'.
std::string plain_text(std::string_view utf8);

}  // namespace itin::viewshed
