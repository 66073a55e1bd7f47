// Preconditions that are checked where ITIN_CHECK_PRECONDITIONS is defined: in all presets but `release`. What a caller
// of the installed headers may get wrong is an InputError instead, in every build.
#pragma once

#include <cstdio>
#include <cstdlib>

#ifdef ITIN_CHECK_PRECONDITIONS
/// Ends the program, naming the place, unless the condition holds.
#define ITIN_PRECONDITION(...) \
  (static_cast<bool>(__VA_ARGS__) ? void() : ::itin::end_by_precondition(#__VA_ARGS__, __FILE__, __LINE__))
#else
/// Compiles the condition without evaluating it.
#define ITIN_PRECONDITION(...) static_cast<void>(sizeof(static_cast<bool>(__VA_ARGS__)))
#endif

namespace itin {

[[noreturn]] inline void end_by_precondition(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: precondition does not hold: %s\n", file, line, condition);
  std::abort();
}

}  // namespace itin
