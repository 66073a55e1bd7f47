// Names of CRSs, as their WKT itself has them. GDAL knows them, too, but takes longer to load than most questions take.
#include <algorithm>
#include <cctype>
#include <string_view>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/crs_words.hpp>

namespace itin {

namespace {

/// Returns the text between the quotation mark at `open` and its counterpart; two marks within it stand for one.
std::string quoted_text(std::string_view wkt, std::size_t open) {
  std::string text;
  for (std::size_t i = open + 1; i < wkt.size(); ++i) {
    if (wkt[i] == '"' && (i + 1 == wkt.size() || wkt[++i] != '"')) break;
    text += wkt[i];
  }
  return text;
}

/// Returns where the outermost node's own child `keyword` has its bracket; npos where there is none.
std::size_t bracket_of_child(std::string_view wkt, std::string_view keyword) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < wkt.size(); ++i) {
    if (wkt[i] == '"') quoted = !quoted;
    if (quoted) continue;
    if (wkt[i] == '[' && depth++ == 1) {
      const std::string_view before = wkt.substr(0, i);
      if (before.ends_with(keyword) && !std::isalpha(static_cast<unsigned char>(before[i - keyword.size() - 1])))
        return i;
    }
    if (wkt[i] == ']') --depth;
  }
  return std::string_view::npos;
}

/// Returns the code that the outermost node has, "EPSG:27700" say; empty where it has none.
std::string authority_and_code(std::string_view wkt) {
  std::size_t bracket = bracket_of_child(wkt, "ID");                                    // WKT 2
  if (bracket == std::string_view::npos) bracket = bracket_of_child(wkt, "AUTHORITY");  // WKT 1
  if (bracket == std::string_view::npos) return "";
  const std::string_view values = wkt.substr(bracket + 1, wkt.find(']', bracket) - bracket - 1);
  const std::size_t comma = values.find(',');
  if (comma == std::string_view::npos) return "";
  std::string code(values.substr(comma + 1));
  std::erase_if(code, [](char c) { return c == '"' || c == ' '; });
  return fmt::format("{}:{}", quoted_text(values, values.find('"')), code);
}

}  // namespace

std::string crs_identifier(const std::string& wkt) {
  const std::string found = authority_and_code(wkt);
  return found.empty() ? wkt : found;
}

std::string crs_title(const std::string& wkt) {
  const std::size_t open = wkt.find('"');
  return open == std::string::npos ? "unnamed" : quoted_text(wkt, open);
}

std::string crs_in_short(const std::string& wkt) {
  const std::string code = authority_and_code(wkt);
  return code.empty() ? crs_title(wkt) : code;
}

std::string crs_in_full(const std::string& wkt) {
  const std::string title = crs_title(wkt), code = authority_and_code(wkt);
  return code.empty() ? title : fmt::format("{} ({})", title, code);
}

}  // namespace itin
