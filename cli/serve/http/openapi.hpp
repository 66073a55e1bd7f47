// The HTTP interface as an OpenAPI document.
#pragma once

#include <itin/document.hpp>

namespace itin::cli {

/// The document of `/api/v1/openapi.json`, OpenAPI 3.1.
Document openapi_document();

}  // namespace itin::cli
