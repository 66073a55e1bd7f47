#include <itin/output_file.hpp>

#include "export/buffered_file.hpp"

namespace itin {

void write_file(const std::string& path, std::string_view bytes, bool overwrite) {
  PendingFile output(path, overwrite);
  BufferedFile file(output);
  file.write(bytes);
  file.close();
  output.commit();
}

void require_output_possible(const std::string& path, bool overwrite) {
  PendingFile::require_possible(path, overwrite);
}

}  // namespace itin
