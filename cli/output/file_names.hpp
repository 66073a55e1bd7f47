// Names of files that lie beside each other, made from names that people give.
//
//   FileNames names;
//   names.add("Mast", 1);   // "Mast"
//   names.add("mast", 2);   // "mast-2": some file systems take both for one
#pragma once

#include <cstddef>
#include <set>
#include <string>

namespace itin::cli {

class FileNames {
 public:
  /// The name as file_name() has it, with the number behind it where another differs by the case of ASCII letters at
  /// most.
  std::string add(const std::string& name, std::size_t number);
  /// Whether no other differs by the case of ASCII letters at most.
  bool insert(const std::string& path);

 private:
  std::set<std::string> taken_;  ///< in lower case
};

}  // namespace itin::cli
