// Whether reading a file may send requests to other machines. It may not, unless the program says so.
//
//   allow_network();  // first of all
//   const Store store("wales.itin");
//
// GDAL opens far more than files: addresses, databases, and files that name these. The libraries refuse all of them,
// and PROJ's grids from the network. What is refused is refused in the whole process, for GDAL and PROJ are shared.
#pragma once

namespace itin {

/// Lets sources, lists and coordinate operations send the requests that they name. Throws InputError once GDAL has been
/// used, for then it is settled that they may not.
void allow_network();

}  // namespace itin
