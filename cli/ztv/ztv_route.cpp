#include "ztv/ztv_route.hpp"

#include <itin/error.hpp>

#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void RouteOptions::declare(CLI::App& app) {
  begin_group(app, "Routes");
  reads(app.add_option("--route", path_,
                       "Roads or paths from a vector file of lines: tables and charts of the hubs and tips visible "
                       "along each")
            ->type_name("FILE"));
  app.add_option("--every", every_text_,
                 "Distance between the places along a route from which turbines are looked for (default: 100)")
      ->type_name("METRES");
}

void RouteOptions::validate() {
  if (every_text_.empty()) return;
  if (!given()) throw InputError("--every works only with --route");
  every_ = parse_radius("--every", every_text_);
}

Document RouteOptions::parameters() const {
  if (!given()) return Document::object();
  return {{"route", path_}, {"every_m", every_}};
}

void RouteOptions::complete(viewshed::ZoneStudyRequest& request, const StoreMetadata& metadata) const {
  if (!given()) return;
  request.routes = viewshed::read_routes(path_, metadata.crs_wkt);
  request.route_step = every_;
}

}  // namespace itin::cli
