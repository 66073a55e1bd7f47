// References to squares of the whole Earth: the Military Grid Reference System (MGRS) and Maidenhead locators.
#pragma once

#include <optional>
#include <string_view>

#include <itin/written_position.hpp>

namespace itin {

/// Reads "30U VB 80100 10100", with an even number of digits up to ten: the south-western corner of the square, in the
/// zone's UTM on WGS 84. Nothing for other texts.
std::optional<WrittenPosition> military_grid(std::string_view text);

/// Reads a locator of 6, 8 or 10 characters, "IO81jm32": the middle of the square, as longitude and latitude. Nothing
/// for other texts.
std::optional<WrittenPosition> maidenhead(std::string_view text);

}  // namespace itin
