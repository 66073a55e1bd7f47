// One line of sight as computed: its report, and the document that says the same to machines.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/store.hpp>
#include <profile/los.hpp>

#include "los/los_store.hpp"
#include "program/verb.hpp"

namespace itin::cli {

struct LosCase {
  profile::LosReport report;
  Result result;
  std::string foliage_text = {};  ///< what --foliage tells
};

/// The data that the reports of all lines of a call begin with.
struct LosHeader {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts = {};  ///< the first facts: name, value
  std::string from_name = {}, to_name = {};                     ///< names of the ends; may be empty
  std::optional<double> table_spacing_m = {};                   ///< as in LosReport
};

/// The case of a profile from a file.
LosCase los_case(profile::LosReport report, const LosHeader& header);
/// The case of a line on a store.
LosCase los_case(const Store& store, LosStoreOptions::Result line, const LosHeader& header);

/// The report as text for people.
std::string text_of(const profile::LosReport& report);

}  // namespace itin::cli
