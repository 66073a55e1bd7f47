#include "gdal/files/network.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_http.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <ogr_srs_api.h>

#include <itin/error.hpp>
#include <itin/network.hpp>
#include <itin/precondition.hpp>

namespace itin {

namespace {

enum class Network { kOpen, kAllowed, kRefused };
std::atomic<Network> network_state = Network::kOpen;

thread_local std::string refusal_of_thread;

/// GDAL's file systems that stay on this machine. Any other is refused, those of a newer GDAL included.
constexpr std::array<std::string_view, 12> kLocalFileSystems = {
    "/vsimem/",     "/vsizip/",    "/vsigzip/",  "/vsitar/",    "/vsi7z/",    "/vsirar/",
    "/vsisubfile/", "/vsisparse/", "/vsicrypt/", "/vsicached?", "/vsistdin/", "/vsistdin?"};

bool is_local(std::string_view prefix) {
  return std::find(kLocalFileSystems.begin(), kLocalFileSystems.end(), prefix) != kLocalFileSystems.end() ||
         prefix.starts_with("/vsistdout");
}

/// A file system that has no file, in place of one that sends requests. `prefix` lives as long as the process.
void refuse_file_system(const char* prefix) {
  const std::unique_ptr<VSIFilesystemPluginCallbacksStruct, decltype(&VSIFreeFilesystemPluginCallbacksStruct)> calls(
      VSIAllocFilesystemPluginCallbacksStruct(), &VSIFreeFilesystemPluginCallbacksStruct);
  calls->pUserData = const_cast<char*>(prefix);
  calls->stat = [](void* before, const char* name, VSIStatBufL*, int) {
    refuse_request(static_cast<const char*>(before) + std::string(name));
    return -1;
  };
  calls->open = [](void* before, const char* name, const char*) -> void* {
    refuse_request(static_cast<const char*>(before) + std::string(name));
    return nullptr;
  };
  VSIInstallPluginHandler(prefix, calls.get());
}

void refuse_file_systems() {
  char** const prefixes = VSIGetFileSystemsPrefixes();  // not freed: the file systems refer to them
  for (char** prefix = prefixes; *prefix != nullptr; ++prefix)
    if (!is_local(*prefix)) refuse_file_system(*prefix);
  refuse_file_system("/vsicurl?");  // another way to write /vsicurl/, which GDAL does not list
}

CPLHTTPResult* refuse_http(const char* url, CSLConstList, GDALProgressFunc, void*, CPLHTTPFetchWriteFunc, void*,
                           void*) {
  refuse_request(url);
  auto* const result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
  result->nStatus = 1;
  result->pszErrBuf = CPLStrdup("refused");
  return result;
}

void refuse_network() {
  refuse_file_systems();
  CPLHTTPSetFetchCallback(refuse_http, nullptr);
  OSRSetPROJEnableNetwork(FALSE);
  CPLSetConfigOption("GML_DOWNLOAD_WFS_SCHEMA", "NO");  // GML reads without it, too
}

/// What GDAL would do for a file beyond reading it, whether or not requests are allowed.
void refuse_foreign_code() {
  CPLSetConfigOption("GDAL_VRT_ENABLE_PYTHON", "NO");
  CPLSetConfigOption("GML_PARSER", "EXPAT");  // Xerces fetches document types and entities by itself
}

}  // namespace

void settle_network() {
  static std::once_flag once;
  std::call_once(once, [] {
    Network open = Network::kOpen;
    network_state.compare_exchange_strong(open, Network::kRefused);
    refuse_foreign_code();
    if (!is_network_allowed()) refuse_network();
  });
}

bool is_network_allowed() {
  ITIN_PRECONDITION(network_state != Network::kOpen);
  return network_state == Network::kAllowed;
}

void allow_network() {
  Network open = Network::kOpen;
  network_state.compare_exchange_strong(open, Network::kAllowed);
  if (!is_network_allowed())
    throw InputError("`allow_network` comes too late: GDAL has been used without it", "allow_network");
}

void refuse(const std::string& reason) {
  if (refusal_of_thread.empty()) refusal_of_thread = reason;
  CPLError(CE_Failure, CPLE_AppDefined, "%s", reason.c_str());
}

void refuse_request(const std::string& what) {
  constexpr std::size_t kShown = 200;
  refuse(fmt::format("needs the network for {:.{}}, and no request leaves this machine without `allow_network`", what,
                     kShown));
}

std::string take_refusal() {
  return std::exchange(refusal_of_thread, {});
}

void require_no_refusal(const std::string& path) {
  if (const std::string refusal = take_refusal(); !refusal.empty()) throw FileError(path, refusal);
}

}  // namespace itin
