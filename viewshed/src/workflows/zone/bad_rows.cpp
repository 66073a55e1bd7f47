#include "workflows/zone/bad_rows.hpp"

#include <fmt/format.h>

namespace itin::viewshed {

Document bad_rows_document(const std::string& file, std::size_t rows, std::size_t used,
                           const std::vector<BadRow>& bad) {
  Document document{{"file", file}, {"rows", rows}, {"used", used}, {"bad", Document::array()}};
  for (const BadRow& row : bad)
    document["bad"].push_back({{"row", row.number}, {"feature", row.feature}, {"message", row.message}});
  return document;
}

std::string bad_row_warning(const std::string& file, const BadRow& row) {
  return fmt::format("{}: row {} ({}) is not used: {}", file, row.number, row.place, row.message);
}

}  // namespace itin::viewshed
