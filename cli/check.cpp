// itin check: whether a store is sound.

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/store.hpp>

#include "store_document.hpp"
#include "verb.hpp"

namespace itin::cli {

namespace {

class CheckVerb final : public Verb {
 public:
  std::string name() const override { return "check"; }
  std::string summary() const override { return "Verify checksums, index, levels and certificates of a store"; }
  void declare(CLI::App& app) override { app.add_option("STORE", store_, "The store")->required(); }
  void validate() override {}
  Document parameters() const override { return {{"store", store_}}; }

  Result execute(Progress& progress) override {
    const Store store(store_);
    const std::vector<Damage> damages = check(store, progress);
    Result result;
    result.document["crs"] = crs_identifier(store.metadata().crs_wkt);
    result.document["sound"] = damages.empty();
    result.document["vertices"] = store.metadata().vertices;
    result.document["bytes"] = store.file_bytes();
    result.document["damage"] = Document::array();
    for (const Damage& damage : damages) {
      result.document["damage"].push_back({{"place", damage.place}, {"what", damage.what}});
      result.text += fmt::format("{}: {}\n", damage.place, damage.what);
    }
    if (damages.empty()) {
      result.text = fmt::format("sound: {} vertices, {}\n", grouped(store.metadata().vertices),
                                readable_bytes(store.file_bytes()));
    } else {
      result.failure =
          fmt::format("{}: damaged in {} place{}, first {}: {}; restore it from a copy or import again", store_,
                      damages.size(), damages.size() == 1 ? "" : "s", damages.front().place, damages.front().what);
    }
    return result;
  }

 private:
  std::string store_;
};

}  // namespace

std::unique_ptr<Verb> make_check_verb() {
  return std::make_unique<CheckVerb>();
}

}  // namespace itin::cli
