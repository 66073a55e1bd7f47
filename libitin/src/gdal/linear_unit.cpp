#include "gdal/linear_unit.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

namespace itin {

namespace {

struct Known {
  int code;  // EPSG's; 0 where the unit has none
  double metres;
  const char* name;
  std::string_view others = {};  // other names, in lower case, between bars
};

// Units after the EPSG dataset v10; names in dialects after ESRI, PROJ, UDUNITS and the output of GDAL's drivers.
constexpr Known kUnits[] = {
    {9001, 1, "metre", "|m|meter|metres|meters|mtr|1 metre|1 m|"},
    {9002, 0.3048, "foot", "|ft|feet|international foot|international feet|foot (international)|ift|foot intl|"},
    {9003, 1200.0 / 3937, "US survey foot",
     "|us ft|ft us|ftus|usft|us foot|us feet|foot us|feet us|us survey feet|survey foot|survey feet|sfoot|sft|"},
    {9036, 1000, "kilometre", "|km|kilometer|kilometres|kilometers|1 km|"},
    {0, 100, "hectometre", "|hm|hectometer|hectometres|hectometers|"},
    {0, 10, "decametre", "|dam|decameter|decametres|decameters|dekameter|"},
    {0, 0.1, "decimetre", "|dm|decimeter|decimetres|decimeters|0.1 m|"},
    {1033, 0.01, "centimetre", "|cm|centimeter|centimetres|centimeters|0.01 m|"},
    {1025, 0.001, "millimetre", "|mm|millimeter|millimetres|millimeters|0.001 m|"},
    {9014, 1.8288, "fathom", "|fathoms|fath|ftm|"},
    {9030, 1852, "nautical mile", "|nautical miles|nmi|kmi|international nautical mile|"},
    {9093, 1609.344, "statute mile", "|mile|miles|mi|statute miles|international mile|"},
    {9096, 0.9144, "yard", "|yd|yards|international yard|"},
    {9097, 20.1168, "chain", "|ch|chains|international chain|"},
    {9098, 0.201168, "link", "|links|international link|"},
    {0, 201.168, "furlong", "|furlongs|"},
    {0, 0.0254, "inch", "|in|inches|international inch|"},
    {0, 100.0 / 3937, "US survey inch", "|us in|us inch|"},
    {0, 3600.0 / 3937, "US survey yard", "|us yd|us yard|"},
    {9033, 79200.0 / 3937, "US survey chain", "|us ch|chain us|"},
    {9034, 792.0 / 3937, "US survey link", "|link us|"},
    {9035, 6336000.0 / 3937, "US survey mile", "|us mi|mile us|"},
    {9005, 0.3047972654, "Clarke's foot", "|foot clarke|clarke foot|"},
    {9031, 1.0000135965, "German legal metre", "|meter german|"},
    {9037, 0.9143917962, "Clarke's yard", "|yard clarke|"},
    {9038, 20.1166195164, "Clarke's chain", "|chain clarke|"},
    {9039, 0.201166195164, "Clarke's link", "|link clarke|"},
    {9040, 0.914398414616029, "British yard (Sears 1922)", "|yard sears|"},
    {9041, 0.304799471538676, "British foot (Sears 1922)", "|foot sears|"},
    {9042, 20.1167651215526, "British chain (Sears 1922)", "|chain sears|"},
    {9043, 0.201167651215526, "British link (Sears 1922)", "|link sears|"},
    {9050, 0.9143992, "British yard (Benoit 1895 A)", "|yard benoit 1895 a|"},
    {9051, 0.304799733333333, "British foot (Benoit 1895 A)", "|foot benoit 1895 a|"},
    {9052, 20.1167824, "British chain (Benoit 1895 A)", "|chain benoit 1895 a|"},
    {9053, 0.201167824, "British link (Benoit 1895 A)", "|link benoit 1895 a|"},
    {9060, 0.914399204289812, "British yard (Benoit 1895 B)", "|yard benoit 1895 b|"},
    {9061, 0.304799734763271, "British foot (Benoit 1895 B)", "|foot benoit 1895 b|"},
    {9062, 20.1167824943759, "British chain (Benoit 1895 B)", "|chain benoit 1895 b|"},
    {9063, 0.201167824943759, "British link (Benoit 1895 B)", "|link benoit 1895 b|"},
    {9070, 0.304800833333333, "British foot (1865)", "|foot 1865|"},
    {9080, 0.304799510248147, "Indian foot", "|foot indian|"},
    {9081, 0.30479841, "Indian foot (1937)", "|foot indian 1937|"},
    {9082, 0.3047996, "Indian foot (1962)", "|foot indian 1962|"},
    {9083, 0.3047995, "Indian foot (1975)", "|foot indian 1975|"},
    {9084, 0.914398530744441, "Indian yard", "|yard indian|"},
    {9085, 0.91439523, "Indian yard (1937)", "|yard indian 1937|"},
    {9086, 0.9143988, "Indian yard (1962)", "|yard indian 1962|"},
    {9087, 0.9143985, "Indian yard (1975)", "|yard indian 1975|"},
    {9094, 0.304799710181509, "Gold Coast foot", "|foot gold coast|"},
    {9095, 0.3048007491, "British foot (1936)", "|foot british 1936|"},
    {9099, 0.914398, "British yard (Sears 1922 truncated)", "|yard sears 1922 truncated|"},
    {9300, 0.304799333333333, "British foot (Sears 1922 truncated)", "|foot sears 1922 truncated|"},
    {9301, 20.116756, "British chain (Sears 1922 truncated)", "|chain sears 1922 truncated|"},
    {9302, 0.20116756, "British link (Sears 1922 truncated)", "|link sears 1922 truncated|"},
};

std::string plain(std::string_view name) {
  const auto brackets = [](char c) { return std::string_view(" \t[]{}'\"").find(c) != std::string_view::npos; };
  while (!name.empty() && brackets(name.front())) name.remove_prefix(1);
  while (!name.empty() && brackets(name.back())) name.remove_suffix(1);
  std::string text;
  for (const char c : name)
    text += c == '_' || c == '-' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_called(const Known& unit, const std::string& text) {
  const bool one = text.find('|') == std::string::npos;
  return text == plain(unit.name) || (one && unit.others.find("|" + text + "|") != std::string_view::npos);
}

template <class Wanted>
std::optional<LinearUnit> first(const Wanted& wanted) {
  const auto* const found = std::find_if(std::begin(kUnits), std::end(kUnits), wanted);
  return found == std::end(kUnits) ? std::nullopt : std::optional(LinearUnit{found->name, found->metres});
}

}  // namespace

std::optional<LinearUnit> linear_unit(int epsg_code) {
  return first([&](const Known& unit) { return unit.code != 0 && unit.code == epsg_code; });
}

std::optional<LinearUnit> linear_unit(const std::string& name) {
  const std::string text = plain(name);
  return first([&](const Known& unit) { return !text.empty() && is_called(unit, text); });
}

std::string unit_name(double metres, const std::string& otherwise) {
  const auto known = first([&](const Known& unit) { return std::abs(unit.metres - metres) <= 1e-10 * metres; });
  return known ? known->name : otherwise;
}

}  // namespace itin
