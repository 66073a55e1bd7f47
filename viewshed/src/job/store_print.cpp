#include <viewshed/job.hpp>

#include "plan/plan_id.hpp"

namespace itin::viewshed {

StorePrint print_of(const Store& store) {
  return {store.file_bytes(), id_of(store.metadata())};
}

}  // namespace itin::viewshed
