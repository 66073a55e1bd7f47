#include "gdal/files/foreign_content.hpp"

#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>

namespace itin {

namespace {

namespace fs = std::filesystem;

using Xml = std::unique_ptr<CPLXMLNode, decltype(&CPLDestroyXMLNode)>;

/// Returns the path of the file that holds it, for a file within an archive.
std::string without_archives(std::string path) {
  for (const std::string_view prefix : {"/vsizip/", "/vsigzip/", "/vsitar/"}) {
    if (path.starts_with(prefix)) return without_archives(path.substr(prefix.size()));
  }
  return path;
}

/// Returns the file of a name that begins with its format, such as CSV:places.txt.
std::string without_format(const std::string& name) {
  const std::size_t letters = name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz");
  return letters != std::string::npos && letters > 1 && name[letters] == ':' ? name.substr(letters + 1) : name;
}

/// Links are followed, for an archive may bring them along. Names without a file stay as they are.
fs::path resolved(const std::string& path) {
  std::error_code failed;
  const fs::path absolute = fs::absolute(path.empty() ? "." : without_archives(path), failed);
  const fs::path canonical = fs::weakly_canonical(absolute, failed);
  return failed ? absolute.lexically_normal() : canonical;
}

bool is_within(const std::string& file, const std::string& folder) {
  const fs::path relative = resolved(file).lexically_relative(resolved(folder));
  return !relative.empty() && *relative.begin() != "..";
}

/// GDAL takes names in a file to be relative to where a link to that file leads.
std::string folder_of(const std::string& name) {
  std::error_code failed;
  const fs::path file = fs::is_symlink(name, failed) ? fs::canonical(name, failed) : fs::path(name);
  return file.parent_path().string();
}

/// What a description reads by itself, without another driver that would know it as a raster.
class Description {
 public:
  explicit Description(const std::string& name)
      : inlined_(name.find('<') != std::string::npos),
        folder_(inlined_ ? std::string() : folder_of(name)),
        xml_(inlined_ ? CPLParseXMLString(name.c_str()) : CPLParseXMLFile(name.c_str()), &CPLDestroyXMLNode) {}

  std::string foreign() const { return foreign_in(xml_.get()); }

 private:
  std::string foreign_in(const CPLXMLNode* first) const {
    for (const CPLXMLNode* node = first; node != nullptr; node = node->psNext) {
      if (node->eType != CXT_Element) continue;
      if (std::string found = foreign_here(*node); !found.empty()) return found;
      if (std::string found = foreign_in(node->psChild); !found.empty()) return found;
    }
    return {};
  }

  std::string foreign_here(const CPLXMLNode& node) const {
    if (EQUAL(node.pszValue, "PixelFunctionLanguage") && EQUAL(CPLGetXMLValue(&node, nullptr, ""), "Python"))
      return "runs Python code, which itin does not; run it yourself and give the raster that it makes";
    if (EQUAL(CPLGetXMLValue(&node, "subClass", ""), "VRTRawRasterBand"))
      return unless_within(named_by(CPLGetXMLNode(&node, "SourceFilename")));
    if (EQUAL(node.pszValue, "SrcDataSource")) return foreign_table(named_by(&node));
    // MRF fills these files from elsewhere where they are not there yet.
    if (EQUAL(node.pszValue, "DataFile") || EQUAL(node.pszValue, "IndexFile"))
      return unless_within(in_folder(CPLGetXMLValue(&node, nullptr, "")));
    return {};
  }

  std::string named_by(const CPLXMLNode* node) const {
    const std::string name = without_format(CPLGetXMLValue(node, nullptr, ""));
    return CPLTestBool(CPLGetXMLValue(node, "relativeToVRT", "0")) ? in_folder(name) : name;
  }

  /// Names that are no files are left to GDAL, which opens them as it does any other.
  std::string foreign_table(const std::string& path) const {
    VSIStatBufL status;
    return VSIStatL(path.c_str(), &status) == 0 ? unless_within(path) : std::string();
  }

  std::string in_folder(const std::string& name) const {
    return CPLProjectRelativeFilename(folder_.c_str(), name.c_str());
  }

  std::string unless_within(const std::string& path) const {
    if (!inlined_ && is_within(path, folder_)) return {};
    return fmt::format("reads {:.200}, which is not in the folder of the file that names it; put both into one folder",
                       path);
  }

  bool inlined_;  ///< has no file, and so no folder
  std::string folder_;
  Xml xml_;
};

}  // namespace

std::string foreign_content(const std::string& name) {
  return Description(name).foreign();
}

bool is_description(const std::string& first_bytes) {
  constexpr std::array kRoots = {"<VRTDataset", "<OGRVRT", "<MRF_META"};
  for (const char* root : kRoots)
    if (first_bytes.find(root) != std::string::npos) return true;
  return false;
}

}  // namespace itin
