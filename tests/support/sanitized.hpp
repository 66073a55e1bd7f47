// Whether a sanitizer watches, under which programs take ten times as long and more.
#pragma once

namespace itin::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace itin::test
