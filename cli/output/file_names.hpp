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
  /// Returns the name as file_name() gives it, with the number behind it where another name is the same but for the
  /// case of ASCII letters.
  std::string add(const std::string& name, std::size_t number);
  /// Adds a path, and tells whether no other is the same but for the case of ASCII letters.
  bool insert(const std::string& path);

 private:
  std::set<std::string> taken_;  ///< in lower case
};

}  // namespace itin::cli
