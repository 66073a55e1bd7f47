#include <itin/coordinates.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/premises_document.hpp>

#include "workflows/premises/output/premises_tables.hpp"

namespace itin::viewshed {

Document counts_document(const PremisesCounts& counts) {
  return {{"all", counts.all},
          {"served", counts.served()},
          {"on_walls", counts.on_walls},
          {"on_roofs", counts.on_roofs},
          {"undecided", counts.undecided},
          {"unserved", counts.unserved},
          {"out_of_reach", counts.out_of_reach}};
}

Document premises_document(const PremisesSurvey& survey) {
  Document document{{"crs", crs_identifier(survey.metadata.crs_wkt)},
                    {"surface", surface_document(survey.metadata, Detail::tolerance(0), survey.request.themes)},
                    {"refraction", earth_document(survey.request.earth)}};
  document["premises"] = counts_document(survey.counts());
  document["masts"] = masts_document(survey);
  document["statistics"] = statistics_document(survey.statistics);
  return document;
}

std::string json_of(const PremisesSurvey& survey) {
  return json_text(premises_document(survey), 2);
}

}  // namespace itin::viewshed
