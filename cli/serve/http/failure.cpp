#include "serve/http/failure.hpp"

#include <algorithm>
#include <exception>
#include <new>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "program/field_names.hpp"

namespace itin::cli {

Document failure_document(const std::string& message) {
  std::string line = in_options(message);
  std::replace(line.begin(), line.end(), '\n', ' ');
  Document document{{"error", line}};
  if (line.starts_with("--")) document["field"] = line.substr(0, line.find_first_of(" :,='"));
  return document;
}

Failure current_failure() {
  try {
    throw;
  } catch (const Cancelled&) {
    throw;
  } catch (const InputError& error) {
    return {400, error.what()};
  } catch (const Error& error) {
    return {500, error.what()};
  } catch (const std::bad_alloc&) {
    return {500, "out of memory; give a smaller --radius or a larger --cell"};
  } catch (const std::exception& error) {
    return {500, fmt::format("an internal error of itin ({}); please report it with what led to it", error.what())};
  }
}

}  // namespace itin::cli
