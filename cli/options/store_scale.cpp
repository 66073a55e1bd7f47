#include "options/store_scale.hpp"

namespace itin::cli {

Document scale_document(const std::optional<GridScale>& scale) {
  return scale ? Document{{"least", scale->least}, {"greatest", scale->greatest}} : Document(nullptr);
}

}  // namespace itin::cli
