// Declarations that the examples in the headers take as given. The examples are compiled, not run.
#pragma once

#include <atomic>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace itin {
extern const Store store;
extern const Tin tin;
extern NoProgress progress;
}  // namespace itin

namespace itin::viewshed {
extern const Request request;
extern const RasterGrid grid;
extern Coverage& coverage;
}  // namespace itin::viewshed

namespace itin::profile {
extern const Profile line;
extern const LosQuery query;
}  // namespace itin::profile
