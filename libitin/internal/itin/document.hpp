// Results as JSON documents, in the names that stay. What a library gives as text is one of these.
//
//   Document document{{"crs", crs_identifier(metadata.crs_wkt)}};
//   document["surface"] = surface_document(metadata, detail, themes);
//   return result_text(document);
#pragma once

#include <cstdint>
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

/// `indent` as in nlohmann's dump(). Names of files and features have whatever bytes they have: what of them is not
/// UTF-8 is replaced by U+FFFD.
std::string json_text(const Document& document, int indent = -1);
/// A result by itself: the document after the version of this program, with a newline.
std::string result_text(const Document& document);

/// [lo, hi] of a certificate.
Document error_interval(const CertifiedError& error);
/// `surface`: tolerance, certified error and themes of the surface that a query at this detail sees. With rings the
/// tolerance is the coarsest, the error covers all, and the rings are listed.
Document surface_document(const StoreMetadata& metadata, const Detail& detail, const ThemeChoice& themes);
/// `sources`: those that something was made of.
Document sources_document(const std::vector<SourceInfo>& sources);
/// `statistics`: what was read, and how many triangles that gave or a line crossed.
Document statistics_document(const RetrievalStatistics& read, std::uint64_t triangles);
/// `refraction`.
Document earth_document(const Earth& earth);
/// [xmin, ymin, xmax, ymax] with names.
Document box_document(const Box& box);

}  // namespace itin
