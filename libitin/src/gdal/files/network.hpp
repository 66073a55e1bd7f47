// No request leaves the machine, unless allow_network() was called before GDAL was used. GDAL sends requests through
// file systems (/vsicurl/ and others), through its own HTTP calls, and through drivers with a client of their own,
// which drivers.cpp takes care of.
#pragma once

#include <string>

namespace itin {

/// Settles whether requests may be sent, when first called; QuietGdal calls it before anything else of GDAL.
void settle_network();

/// Tells what is settled. Precondition: settle_network() was called.
bool is_network_allowed();

/// Keeps in mind, for this thread, why something is not read, and fails in GDAL's way. The first reason counts.
void refuse(const std::string& reason);

/// Refuses a request, where `what` is an address or a name.
void refuse_request(const std::string& what);

/// Returns why this thread's reading was refused since the last call; empty where it was not.
std::string take_refusal();

/// Throws FileError where something was refused since the last take_refusal().
void require_no_refusal(const std::string& path);

}  // namespace itin
