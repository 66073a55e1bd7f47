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
  const std::vector<MastService> services = services_of(survey);
  document["masts"] = Document::array();
  for (std::size_t i = 0; i < services.size(); ++i) {
    const SitePosition& mast = survey.masts[i];
    document["masts"].push_back({{"name", mast.name},
                                 {"x", mast.position.x},
                                 {"y", mast.position.y},
                                 {"height_m", mast.height},
                                 {"stands_on_m", mast.ground},
                                 {"within_reach", services[i].within_reach},
                                 {"serves", services[i].serves},
                                 {"serves_best", services[i].best}});
  }
  document["statistics"] = statistics_document(survey.statistics);
  return document;
}

std::string json_of(const PremisesSurvey& survey) {
  return json_text(premises_document(survey), 2);
}

}  // namespace itin::viewshed
