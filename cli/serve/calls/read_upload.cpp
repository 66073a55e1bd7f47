// itin read-upload: what the server calls to read a file that a client has sent. It tells the places or the polygons in
// it, in the store's CRS, and what is wrong with it. It gives itself little memory and time first.

#include <algorithm>
#include <sys/resource.h>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/parsed_number.hpp>
#include <itin/site_table.hpp>
#include <itin/store.hpp>
#include <itin/window_source.hpp>

#include "options/memory_option.hpp"
#include "options/places/off_the_data.hpp"
#include "program/call_files.hpp"
#include "program/verb.hpp"

namespace itin::cli {

namespace {

/// What the program itself takes, with its libraries.
constexpr std::uint64_t kProgramBytes = std::uint64_t{256} << 20;
constexpr rlim_t kMostSeconds = 20;
constexpr std::size_t kMostPlaces = 10000;
constexpr std::size_t kMostNamed = 3;
constexpr const char* kName = "name";
constexpr const char* kFields[] = {"height", "hub_height", "rotor_diameter", "tip_height"};

/// Address sanitizers take terabytes of addresses for themselves.
#ifdef __SANITIZE_ADDRESS__
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif

void limit(decltype(RLIMIT_CPU) resource, rlim_t most) {
  const rlimit both{most, most};
  setrlimit(resource, &both);
}

Document place_document(const SiteRow& row) {
  Document place{{"x", row.position->x}, {"y", row.position->y}};
  if (row.values.front()) place[kName] = *row.values.front();
  for (std::size_t i = 0; i < std::size(kFields); ++i) {
    const auto& text = row.values[i + 1];
    const auto value = text ? whole_text_as<double>(*text) : std::nullopt;
    if (value) place[std::string(kFields[i]) + "_m"] = *value;
  }
  return place;
}

Document rings_of(const Window& window) {
  Document rings = Document::array();
  for (const Window::Polygon& part : window.parts()) {
    Document ring = Document::array();
    for (const Point2 corner : part.outer) ring.insert(ring.end(), {corner.x, corner.y});
    rings.push_back(std::move(ring));
  }
  return rings;
}

/// Tells of rows that cannot be used, the first few of them by name.
std::string unusable_text(const std::vector<std::string>& rows) {
  std::string text = rows.size() == 1 ? "1 row cannot be used" : fmt::format("{} rows cannot be used", rows.size());
  for (std::size_t i = 0; i < std::min(rows.size(), kMostNamed); ++i) text += (i == 0 ? ": " : "; ") + rows[i];
  if (rows.size() > kMostNamed) text += fmt::format("; and {} more", rows.size() - kMostNamed);
  return text;
}

class ReadUploadVerb final : public Verb {
 public:
  std::string name() const override { return "read-upload"; }
  std::string summary() const override { return "Tell what is in a file that a client of the server has sent"; }
  bool is_internal() const override { return true; }

  void declare(CLI::App& app) override {
    reads(app.add_option("STORE", store_, "The store")->required());
    reads(app.add_option("FILE", file_, "The file")->required());
    memory_.declare(app, "Memory to read it in");
  }
  void validate() override {}
  Document parameters() const override { return {{"store", store_}, {"file", file_}}; }

  Result execute(Progress&) override {
    limit(RLIMIT_CPU, kMostSeconds);
    if (kLimitsMemory && memory_.bytes()) limit(RLIMIT_DATA, *memory_.bytes() + kProgramBytes);
    const Store store(store_);
    Result result;
    read(store.metadata(), result);
    return result;
  }

 private:
  void read(const StoreMetadata& metadata, Result& result) {
    SiteQuery query;
    query.path = file_;
    std::vector<SiteField> fields{{kName}};
    for (const char* field : kFields) fields.push_back({field});
    Document places = Document::array();
    std::vector<std::string> unusable;
    bool any_off = false;
    const std::vector<SiteRow> rows = read_site_rows(query, fields, metadata.crs_wkt, result.warnings);
    for (const SiteRow& row : rows) {
      const auto off = row.position ? off_the_data(*row.position, {}, metadata) : std::nullopt;
      any_off = any_off || off;
      if (!row.position || off)
        unusable.push_back(fmt::format("{}: {}", row.place, off.value_or(row.error)));
      else if (places.size() < kMostPlaces)
        places.push_back(place_document(row));
    }
    if (rows.empty()) throw InputError(fmt::format("{}: holds nothing", file_));
    // GeoJSON may have lines, such as roads, and polygons.
    if (places.empty() && (any_off || ending_of(file_) != ".geojson"))
      throw InputError(fmt::format("{}: {}", file_, unusable.front()));
    result.document = {{"rows", rows.size()}, {"unusable", 0}, {"places", places}, {"rings", Document::array()}};
    if (places.empty()) {
      result.document["rings"] = rings(metadata.crs_wkt);
    } else if (!unusable.empty()) {
      result.document["unusable"] = unusable.size();
      result.warnings.push_back(unusable_text(unusable));
    }
  }

  /// The outlines of the polygons in the file; none where it has none.
  Document rings(const std::string& crs_wkt) const {
    try {
      return rings_of(window_from_polygon(file_, crs_wkt));
    } catch (const InputError&) {
      return Document::array();
    }
  }

  std::string store_, file_;
  MemoryOption memory_;
};

}  // namespace

std::unique_ptr<Verb> make_read_upload_verb() {
  return std::make_unique<ReadUploadVerb>();
}

}  // namespace itin::cli
