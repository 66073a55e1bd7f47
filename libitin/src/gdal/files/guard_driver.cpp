#include "gdal/files/guard_driver.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include <gdal_priv.h>

#include "gdal/files/foreign_content.hpp"
#include "gdal/files/network.hpp"

namespace itin {

namespace {

/// A driver that sends requests, connects to a database or runs another program. `mark` is how a name begins, or what
/// the first bytes of a file have, where the driver cannot tell by itself what is for it.
struct NetworkDriver {
  std::string_view name;
  std::string_view mark = {};
};
constexpr std::array kNetworkDrivers = {
    // Services
    NetworkDriver{"AmigoCloud"}, NetworkDriver{"CARTO"}, NetworkDriver{"Cloudant"}, NetworkDriver{"CouchDB"},
    NetworkDriver{"CSW"}, NetworkDriver{"DAAS"}, NetworkDriver{"DODS", "DODS:"}, NetworkDriver{"EEDA"},
    NetworkDriver{"EEDAI"}, NetworkDriver{"Elasticsearch"}, NetworkDriver{"HTTP"}, NetworkDriver{"NGW"},
    NetworkDriver{"OAPIF"}, NetworkDriver{"OGCAPI"}, NetworkDriver{"PLMOSAIC"}, NetworkDriver{"PLSCENES"},
    NetworkDriver{"STACIT"}, NetworkDriver{"STACTA"}, NetworkDriver{"WCS"}, NetworkDriver{"WFS"}, NetworkDriver{"WMS"},
    NetworkDriver{"WMTS"},
    // Databases
    NetworkDriver{"ADBC"}, NetworkDriver{"GEORASTER"}, NetworkDriver{"HANA"}, NetworkDriver{"MongoDBv3"},
    NetworkDriver{"MSSQLSpatial", "MSSQL:"}, NetworkDriver{"MySQL"}, NetworkDriver{"OCI", "OCI:"},
    NetworkDriver{"ODBC"}, NetworkDriver{"OGR_OGDI", "gltp:"}, NetworkDriver{"PGeo"}, NetworkDriver{"PostGISRaster"},
    NetworkDriver{"PostgreSQL"},
    // Programs, and readers of XML that fetch what a document type names
    NetworkDriver{"GMLAS"}, NetworkDriver{"GPSBabel"}, NetworkDriver{"Interlis 2", "interlis.ch/INTERLIS2"},
    NetworkDriver{"NAS"}};

struct TakenOut {
  GDALDriver* driver;
  std::string_view mark;
};
std::vector<TakenOut>& taken_out() {
  static std::vector<TakenOut> drivers;
  return drivers;
}

std::string_view first_bytes(const GDALOpenInfo& file) {
  return {reinterpret_cast<const char*>(file.pabyHeader), static_cast<std::size_t>(file.nHeaderBytes)};
}

bool is_for(const TakenOut& network, GDALOpenInfo& file) {
  if (!network.mark.empty())
    return STARTS_WITH_CI(file.pszFilename, std::string(network.mark).c_str()) ||
           first_bytes(file).find(network.mark) != std::string_view::npos;
  return network.driver->pfnIdentify != nullptr && network.driver->pfnIdentify(&file) > 0;
}

/// Tells whether a name has an address in it, as in NETCDF:"http://...". A description in place of a name has addresses
/// that nobody asks.
bool names_address(std::string_view name) {
  if (name.empty() || std::string_view("<{[").find(name.front()) != std::string_view::npos) return false;
  for (std::size_t at = name.find("://"); at != std::string_view::npos; at = name.find("://", at + 1)) {
    std::size_t begin = at;
    while (begin > 0 && std::isalnum(static_cast<unsigned char>(name[begin - 1]))) --begin;
    const std::string_view scheme = name.substr(begin, at - begin);
    if (!scheme.empty() && scheme != "file" && scheme != "vrt") return true;
  }
  return false;
}

bool sends_requests(GDALOpenInfo& file) {
  return names_address(file.pszFilename) ||
         std::any_of(taken_out().begin(), taken_out().end(), [&](const TakenOut& d) { return is_for(d, file); });
}

int look_at(GDALOpenInfo* file) {
  if (!is_network_allowed() && sends_requests(*file)) {
    refuse_request(file->pszFilename);
  } else if (is_description(file->nHeaderBytes > 0 ? std::string(first_bytes(*file)) : file->pszFilename)) {
    if (const std::string foreign = foreign_content(file->pszFilename); !foreign.empty()) refuse(foreign);
  }
  return FALSE;
}

GDALDriver* guard() {
  static GDALDriver* const driver = [] {
    auto* const made = new GDALDriver;  // GDAL deletes it
    made->SetDescription("itin");
    made->SetMetadataItem(GDAL_DMD_LONGNAME, "Refuses what sends requests");
    for (const char* capability : {GDAL_DCAP_OPEN, GDAL_DCAP_RASTER, GDAL_DCAP_VECTOR})
      made->SetMetadataItem(capability, "YES");
    made->pfnIdentify = look_at;
    made->pfnOpen = [](GDALOpenInfo* file) -> GDALDataset* {
      look_at(file);
      return nullptr;
    };
    return made;
  }();
  return driver;
}

/// Keeps those that send requests out of GDAL's list, and in mind.
bool take_out(GDALDriver& driver) {
  const auto known = std::find_if(kNetworkDrivers.begin(), kNetworkDrivers.end(), [&](const NetworkDriver& network) {
    return EQUAL(std::string(network.name).c_str(), driver.GetDescription());
  });
  if (is_network_allowed() || known == kNetworkDrivers.end()) return false;
  taken_out().push_back({&driver, known->mark});
  return true;
}

}  // namespace

void put_guard_first() {
  GDALDriverManager& manager = *GetGDALDriverManager();
  std::vector<GDALDriver*> all;
  for (int i = 0; i < manager.GetDriverCount(); ++i)
    if (manager.GetDriver(i) != guard()) all.push_back(manager.GetDriver(i));
  manager.DeregisterDriver(guard());
  for (GDALDriver* driver : all) manager.DeregisterDriver(driver);
  manager.RegisterDriver(guard());
  for (GDALDriver* driver : all)
    if (!take_out(*driver)) manager.RegisterDriver(driver);
}

}  // namespace itin
