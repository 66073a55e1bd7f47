// itin check: whether a store is sound.

#include <optional>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/store.hpp>
#include <itin/verify.hpp>

#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/verb.hpp"

namespace itin::cli {

namespace {

/// The number of tiles that --quick verifies, of the ground and of each part of what stands on it.
constexpr std::size_t kSample = 16;

class CheckVerb final : public Verb {
 public:
  std::string name() const override { return "check"; }
  std::string summary() const override { return "Verify checksums, index, levels and certificates of a store"; }
  void declare(CLI::App& app) override {
    reads(app.add_option("STORE", store_, "The store")->required());
    app.add_flag(
        "--quick", quick_,
        fmt::format("Compare surfaces with what certificates and heights of features say not everywhere, but in "
                    "{} tiles of the ground spread over the store, and as many of each part of what stands on "
                    "it; every byte is read in any case",
                    kSample));
  }
  void validate() override {}
  Document parameters() const override { return {{"store", store_}, {"quick", quick_}}; }

  Result execute(Progress& progress) override {
    const Store store(store_);
    std::vector<Damage> damages = check(store, progress);
    // Surfaces are verified only if everything can be read.
    std::optional<Verification> surfaces;
    if (damages.empty()) surfaces = verify(store, {quick_ ? kSample : 0}, progress);
    if (surfaces) damages = surfaces->damage;
    Result result;
    result.document["crs"] = crs_identifier(store.metadata().crs_wkt);
    result.document["sound"] = damages.empty();
    result.document["vertices"] = store.metadata().vertices;
    result.document["bytes"] = store.file_bytes();
    if (surfaces)
      result.document["surfaces"] = {{"tiles", surfaces->tiles}, {"tiles_verified", surfaces->tiles_verified}};
    result.document["damage"] = Document::array();
    for (const Damage& damage : damages) {
      result.document["damage"].push_back({{"place", damage.place}, {"what", damage.what}});
      result.text += fmt::format("{}: {}\n", damage.place, damage.what);
    }
    if (damages.empty()) {
      result.text = fmt::format("sound: {} vertices, {}; surfaces verified {}\n", grouped(store.metadata().vertices),
                                readable_bytes(store.file_bytes()), extent_text(*surfaces));
    } else {
      result.failure = fmt::format("{}: damaged in {}, first {}: {}; restore it from a copy or import again", store_,
                                   counted(damages.size(), "place"), damages.front().place, damages.front().what);
    }
    return result;
  }

 private:
  static std::string extent_text(const Verification& surfaces) {
    if (surfaces.tiles_verified == surfaces.tiles) return "everywhere";
    return fmt::format("in {} of {} tiles", grouped(surfaces.tiles_verified), grouped(surfaces.tiles));
  }

  std::string store_;
  bool quick_ = false;
};

}  // namespace

std::unique_ptr<Verb> make_check_verb() {
  return std::make_unique<CheckVerb>();
}

}  // namespace itin::cli
