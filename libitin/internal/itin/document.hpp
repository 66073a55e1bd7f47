// Results as JSON documents, whose names stay from version to version. Results that a library gives as text are such
// documents.
//
//   Document document{{"crs", crs_identifier(metadata.crs_wkt)}};
//   document["surface"] = surface_document(metadata, detail, themes);
//   return result_text(document);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <itin/detail.hpp>
#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>

namespace itin {

using Document = nlohmann::ordered_json;

/// Writes the document; `indent` is as in nlohmann's dump(). Names of files and features may have any bytes: those that
/// are not UTF-8 are replaced by U+FFFD.
std::string json_text(const Document& document, int indent = -1);
/// Writes a result by itself: the document after the version of this program, with a newline.
std::string result_text(const Document& document);

/// Returns a number; null where there is none, or one that JSON does not have.
Document number_or_null(const std::optional<double>& number);
/// Returns [lo, hi] of a certificate.
Document error_interval(const CertifiedError& error);
/// Returns `surface`: tolerance, certified error and themes of the surface that a query at this detail sees. With rings
/// the tolerance is the coarsest, the error covers all rings, and the rings are listed. Features that the query leaves
/// out are listed as `without`.
Document surface_document(const StoreMetadata& metadata, const Detail& detail, const ThemeChoice& themes);
/// Returns `sources`: the sources that something was made of.
Document sources_document(const std::vector<SourceInfo>& sources);
/// Returns `statistics`: what was read, and how many triangles resulted or were crossed by a line.
Document statistics_document(const RetrievalStatistics& read, std::uint64_t triangles);
/// Returns `refraction`.
Document earth_document(const Earth& earth);
/// Returns [xmin, ymin, xmax, ymax] with names.
Document box_document(const Box& box);

}  // namespace itin
