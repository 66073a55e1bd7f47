#include "gdal/drivers.hpp"

#include <mutex>

#include <gdal_frmts.h>
#include <ogrsf_frmts.h>

#include <itin/gdal_ready.hpp>

namespace itin {

namespace {

/// Registers drivers, one thread at a time: two at once destroy GDAL's tables.
void register_once(std::once_flag& done, void (*drivers)()) {
  static std::mutex registering;
  std::call_once(done, [&] {
    const std::lock_guard lock(registering);
    drivers();
  });
}

void register_all_drivers() {
  static std::once_flag done;
  register_once(done, [] { GDALAllRegister(); });
}

/// Returns what `find` finds with the drivers of make_gdal_ready(), else with all drivers.
template <class Find>
auto found_by_drivers(const Find& find) {
  make_gdal_ready();
  if (auto found = find()) return found;
  register_all_drivers();
  return find();
}

}  // namespace

GDALDatasetUniquePtr open_dataset(const std::string& path, unsigned kinds, const char* const* options) {
  return found_by_drivers([&] {
    return GDALDatasetUniquePtr(GDALDataset::Open(path.c_str(), kinds | GDAL_OF_READONLY, nullptr, options, nullptr));
  });
}

GDALDriver* driver_of(const std::string& path, unsigned kinds) {
  return found_by_drivers(
      [&] { return static_cast<GDALDriver*>(GDALIdentifyDriverEx(path.c_str(), kinds, nullptr, nullptr)); });
}

void make_gdal_ready() {
  static std::once_flag done;
  register_once(done, [] {
    GDALRegister_GTiff();  // COG uses it for writing
    GDALRegister_COG();
    GDALRegister_MEM();
    RegisterOGRGeoPackage();
    RegisterOGRMEM();
    RegisterOGRCSV();
  });
}

GDALDriver* written_driver(const char* name) {
  make_gdal_ready();
  return GetGDALDriverManager()->GetDriverByName(name);
}

}  // namespace itin
