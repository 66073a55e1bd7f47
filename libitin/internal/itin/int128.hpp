// Whole numbers of 128 bits, which GCC and Clang have on every 64-bit machine.
#pragma once

namespace itin {

__extension__ typedef __int128 Int128;

}  // namespace itin
