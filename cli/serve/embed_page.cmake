# Writes the source OUTPUT of page_files(), with all files below PAGE, compressed.
file(GLOB_RECURSE files RELATIVE ${PAGE} ${PAGE}/*)
list(SORT files)
set(arrays "")
set(entries "")
set(number 0)
foreach(name IN LISTS files)
  file(ARCHIVE_CREATE OUTPUT ${OUTPUT}.gz PATHS ${PAGE}/${name} FORMAT raw COMPRESSION GZip)
  file(READ ${OUTPUT}.gz bytes HEX)
  # Equal files give equal programs: bytes 4 to 7 are the time of compression.
  string(SUBSTRING "${bytes}" 0 8 before)
  string(SUBSTRING "${bytes}" 16 -1 behind)
  set(bytes "${before}00000000${behind}")
  string(LENGTH "${bytes}" digits)
  math(EXPR size "${digits} / 2")
  string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
  string(APPEND arrays "constexpr char kPageFile${number}[] = \"${bytes}\";\n")
  string(APPEND entries "    {\"${name}\", {kPageFile${number}, ${size}}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(REMOVE ${OUTPUT}.gz)
file(WRITE ${OUTPUT} "#include \"serve/http/page_files.hpp\"\n\nnamespace itin::cli {\n\nnamespace {\n\n${arrays}
constexpr PageFile kPageFiles[] = {\n${entries}};\n\n}  // namespace\n
std::span<const PageFile> page_files() {\n  return kPageFiles;\n}\n\n}  // namespace itin::cli\n")
