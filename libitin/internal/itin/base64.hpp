// Bytes as text, for data embedded in documents (RFC 4648).
#pragma once

#include <string>
#include <string_view>

namespace itin {

std::string base64(std::string_view bytes);

}  // namespace itin
