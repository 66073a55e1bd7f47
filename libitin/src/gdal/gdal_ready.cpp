#include <itin/gdal_ready.hpp>

#include "gdal/quiet_gdal.hpp"

namespace itin {

void make_gdal_ready() {
  const QuietGdal registers_drivers;
}

}  // namespace itin
