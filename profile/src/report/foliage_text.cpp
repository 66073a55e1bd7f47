#include <utility>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <profile/documents.hpp>
#include <profile/foliage_text.hpp>

namespace itin::profile {

namespace {

Document loss_document(const std::optional<WoodLoss>& loss) {
  if (!loss) return nullptr;
  return {{"section", loss->end_within ? "2" : "3, as a preset"},
          {"through_db", loss->through_db},
          {"over_db", number_or_null(loss->over_db)},
          {"loss_db", loss->loss_db}};
}

Document stretches_document(const std::vector<FoliageStretch>& stretches, const std::vector<std::string>& themes) {
  Document document = Document::array();
  for (const FoliageStretch& s : stretches)
    document.push_back({{"from_m", s.from_m},
                        {"to_m", s.to_m},
                        {"length_m", s.length_m},
                        {"theme", s.theme < themes.size() ? Document(themes[s.theme]) : Document(nullptr)}});
  return document;
}

}  // namespace

std::string foliage_rule_text(const Foliage& foliage) {
  const std::string leaves = foliage.leaf_area_field.empty()
                                 ? fmt::format("leaf area {:g} m²/m³", foliage.leaf_area)
                                 : fmt::format("leaf areas by the field {}", foliage.leaf_area_field);
  return fmt::format("{}, extinction {:g}; visible from {:g} % of the light on", leaves, foliage.extinction,
                     100 * foliage.least_transmittance);
}

Document foliage_document(const FoliageSight& sight, const Foliage& foliage) {
  Document document{
      {"length_m", sight.length_m},
      {"transmittance", sight.transmittance},
      {"least_transmittance", foliage.least_transmittance},
      {"extinction", foliage.extinction},
      {"leaf_area_m2_per_m3", foliage.leaf_area},
      {"leaf_area_field", foliage.leaf_area_field.empty() ? Document(nullptr) : Document(foliage.leaf_area_field)},
      {"verdict_without_foliage", name_of(sight.solid.verdict)},
      {"stretches", stretches_document(sight.stretches, sight.solid.themes)}};
  if (sight.solid.query.radio) document["p833"] = loss_document(sight.loss);
  return document;
}

Document foliage_document(const PathFoliage& path, const std::vector<std::string>& themes) {
  return {{"length_m", path.length_m},
          {"transmittance", path.transmittance},
          {"stretches", stretches_document(path.stretches, themes)}};
}

std::string foliage_text(const PathFoliage& path) {
  return fmt::format("{:.2f} m of foliage on the path; {} % of the light would come along it", path.length_m,
                     significant(100 * path.transmittance, 3));
}

std::string foliage_text(const FoliageSight& sight, const Foliage& foliage) {
  std::string text =
      fmt::format("{:.2f} m of foliage on the line; {} % of the light comes through, {:g} % are enough", sight.length_m,
                  significant(100 * sight.transmittance, 3), 100 * foliage.least_transmittance);
  if (!sight.loss) return text;
  const WoodLoss& loss = *sight.loss;
  if (loss.end_within) return text + fmt::format("; {:.1f} dB by P.833 section 2", loss.loss_db);
  if (!loss.over_db) return text + fmt::format("; {:.1f} dB through the wood", loss.through_db);
  return text + fmt::format(
                    "; {:.1f} dB through the wood, {:.1f} dB over it, {:.1f} dB in all by a preset for P.833 "
                    "section 3",
                    loss.through_db, *loss.over_db, loss.loss_db);
}

LosReport report_through(FoliageSight sight, const Foliage& foliage) {
  const std::string text = foliage_text(sight, foliage);
  LosReport report = std::move(sight.solid);
  report.verdict = sight.verdict;
  report.facts.emplace_back("Foliage", text);
  return report;
}

std::string json_of(const Store& store, const StoreLine& line, const FoliageSight& sight, const Foliage& foliage) {
  Document document = los_document(store.metadata(), line, report_through(sight, foliage));
  document["foliage"] = foliage_document(sight, foliage);
  return result_text(document);
}

}  // namespace itin::profile
