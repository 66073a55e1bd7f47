// Whether a store is sound, as `itin check` finds out.
#pragma once

#include <gtest/gtest.h>

#include <itin/store.hpp>
#include <itin/verify.hpp>

namespace itin::test {

inline void expect_sound(const Store& store) {
  NoProgress progress;
  for (const Damage& damage : check(store, progress)) ADD_FAILURE() << damage.place << ": " << damage.what;
  for (const Damage& damage : verify(store, {}, progress).damage) ADD_FAILURE() << damage.place << ": " << damage.what;
}

}  // namespace itin::test
