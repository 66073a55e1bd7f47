#include "gdal/files/drivers.hpp"

#include <atomic>
#include <mutex>

#include <gdal_frmts.h>
#include <ogrsf_frmts.h>

#include <itin/gdal_ready.hpp>

#include "gdal/files/guard_driver.hpp"
#include "gdal/files/network.hpp"

namespace itin {

namespace {

/// The drivers that may open files; null: all.
constexpr const char* kTableDrivers[] = {"CSV", "GeoJSON", nullptr};
std::atomic<const char* const*> reading_drivers = nullptr;

/// Registers drivers, one thread at a time: two at once destroy GDAL's tables.
void register_once(std::once_flag& done, void (*drivers)()) {
  static std::mutex registering;
  std::call_once(done, [&] {
    const std::lock_guard lock(registering);
    settle_network();
    drivers();
    put_guard_first();
  });
}

void register_all_drivers() {
  static std::once_flag done;
  register_once(done, [] { GDALAllRegister(); });
}

/// Returns what `find` finds with the drivers of make_gdal_ready(), else with all drivers. Throws FileError for what is
/// refused.
template <class Find>
auto found_by_drivers(const std::string& path, const Find& find) {
  make_gdal_ready();
  take_refusal();
  auto found = find();
  require_no_refusal(path);
  if (found) return found;
  register_all_drivers();
  found = find();
  require_no_refusal(path);
  return found;
}

/// A virtual file opens what its layers name when they are first used, and leaves out what cannot be opened.
void open_layers(GDALDataset& dataset) {
  if (dataset.GetDriver() == nullptr || !EQUAL(dataset.GetDriver()->GetDescription(), "OGR_VRT")) return;
  for (OGRLayer* layer : dataset.GetLayers()) layer->GetLayerDefn();
}

}  // namespace

GDALDatasetUniquePtr open_dataset(const std::string& path, unsigned kinds, const char* const* options) {
  return found_by_drivers(path, [&] {
    GDALDatasetUniquePtr dataset(
        GDALDataset::Open(path.c_str(), kinds | GDAL_OF_READONLY, reading_drivers, options, nullptr));
    if (dataset) open_layers(*dataset);
    return dataset;
  });
}

GDALDriver* driver_of(const std::string& path, unsigned kinds) {
  return found_by_drivers(path, [&] {
    return static_cast<GDALDriver*>(GDALIdentifyDriverEx(path.c_str(), kinds, reading_drivers, nullptr));
  });
}

void make_gdal_ready() {
  static std::once_flag done;
  register_once(done, [] {
    GDALRegister_GTiff();  // COG uses it for writing
    GDALRegister_COG();
    GDALRegister_MEM();
    RegisterOGRGeoPackage();
    RegisterOGRMEM();
  });
}

void read_tables_alone() {
  reading_drivers = kTableDrivers;
}

GDALDriver* written_driver(const char* name) {
  make_gdal_ready();
  return GetGDALDriverManager()->GetDriverByName(name);
}

}  // namespace itin
