# Installs BUILD_DIR below WORK_DIR, then configures, builds and runs a consumer and the examples against it. With SHARED,
# shared libraries are built from ROOT_DIR into BUILD_DIR first.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "status ${status}: ${command}")
  endif()
endfunction()

# What a shared library exports is itin's own.
function(check_symbols library)
  execute_process(COMMAND nm --dynamic --defined-only --demangle ${library} OUTPUT_VARIABLE symbols
    COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "[;\\[]" "" symbols "${symbols}")
  string(REGEX REPLACE "\n" ";" symbols "${symbols}")
  list(LENGTH symbols count)
  list(FILTER symbols EXCLUDE REGEX "^[0-9a-f]+ . (([a-zA-Z -]+ (for|to) )?itin::)|^$")
  if(symbols OR count LESS 10)
    list(JOIN symbols "\n" symbols)
    message(FATAL_ERROR "${library} exports ${count} symbols, of which foreign:\n${symbols}")
  endif()
endfunction()

# Compiles the consumer by what pkg-config says of the package alone.
function(check_pkgconfig)
  set(ENV{PKG_CONFIG_PATH} ${WORK_DIR}/prefix/lib/pkgconfig)
  execute_process(COMMAND pkg-config --cflags --libs itin-viewshed itin-profile OUTPUT_VARIABLE flags
    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags} ${CXX_FLAGS}")
  run(${CXX_COMPILER} -std=c++20 ${ROOT_DIR}/tests/consumer/consumer.cpp -o ${WORK_DIR}/by-pkg-config ${flags}
    -Wl,-rpath,${WORK_DIR}/prefix/lib)
  run(${CMAKE_COMMAND} -E chdir ${WORK_DIR} ${WORK_DIR}/by-pkg-config)
endfunction()

# Writes the blocks of a page that are marked with this language.
function(write_blocks page language output)
  file(READ ${page} text)
  string(REPLACE ";" "\\;" text "${text}")
  string(REGEX MATCH "\n```${language}\n.*" text "${text}")
  string(REGEX REPLACE "^\n```${language}\n" "" text "${text}")
  string(FIND "${text}" "\n```" end)
  string(SUBSTRING "${text}" 0 ${end} text)
  string(REPLACE "\\;" ";" text "${text}")
  file(WRITE ${output} "${text}\n")
endfunction()

# Builds and runs the program of docs/cpp.md, whose cells are those of the command line. The lines in README are compiled.
function(run_guide)
  write_blocks(${ROOT_DIR}/docs/cpp.md cmake ${WORK_DIR}/guide/CMakeLists.txt)
  write_blocks(${ROOT_DIR}/docs/cpp.md cpp ${WORK_DIR}/guide/seen.cpp)
  write_blocks(${ROOT_DIR}/README.md cpp ${WORK_DIR}/guide/lines.inc)
  file(WRITE ${WORK_DIR}/guide/readme.cpp "#include <itin/itin.hpp>\n#include <viewshed/result_files.hpp>\n"
    "#include <viewshed/viewshed.hpp>\nvoid in_readme();\nvoid in_readme() {\n#include \"lines.inc\"\n}\n")
  file(APPEND ${WORK_DIR}/guide/CMakeLists.txt "target_sources(seen PRIVATE readme.cpp)\n")
  run(${CMAKE_COMMAND} -S ${WORK_DIR}/guide -B ${WORK_DIR}/guide/build ${ARGV})
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/guide/build)
  file(CREATE_LINK ${ROOT_DIR}/scripts ${WORK_DIR}/scripts SYMBOLIC)
  run(${CMAKE_COMMAND} -E chdir ${WORK_DIR} ${WORK_DIR}/guide/build/seen)
  itin(viewshed seen.itin --observer 321800,4297750,2 --radius 300 --cell 1 -o seen.tif)
  foreach(name IN ITEMS seen seen-from-cpp)
    run(gdal_translate -q -of XYZ ${WORK_DIR}/${name}.tif ${WORK_DIR}/${name}.xyz)
  endforeach()
  run(${CMAKE_COMMAND} -E compare_files ${WORK_DIR}/seen.xyz ${WORK_DIR}/seen-from-cpp.xyz)
endfunction()

function(itin)
  run(${CMAKE_COMMAND} -E chdir ${WORK_DIR} ${WORK_DIR}/prefix/bin/itin ${ARGV})
endfunction()

# Runs each on a small town.
function(run_examples examples)
  set(data ${ROOT_DIR}/scripts/demo-data)
  file(WRITE ${WORK_DIR}/links.csv
    "id,x1,y1,h1,x2,y2,h2\nstreet,321590,4297655,10,321790,4297662,12\nroofs,321600,4297640,2,321800,4297750,2\n")
  file(WRITE ${WORK_DIR}/turbines.csv "x,y,hub_height,rotor_diameter\n321700,4297650,40,30\n321900,4297850,40,30\n")
  foreach(command IN ITEMS
      "make_store|town.itin|${data}/alexandria-dtm.tif|${data}/alexandria-buildings.geojson"
      "viewshed|town.itin|321800|4297750"
      "line_of_sight|town.itin|321590|4297655|10|321790|4297662|12"
      "links|town.itin|${WORK_DIR}/links.csv|judged.csv"
      "siting|town.itin|cameras"
      "premises|town.itin|321790|4297662|18|served"
      "wind_farm|town.itin|${WORK_DIR}/turbines.csv|zone"
      "segments|town.itin|321800|4297750|work|2"
      "segments|town.itin|321800|4297750|work"
      "cancel|town.itin|0")
    string(REPLACE "|" ";" command ${command})
    run(${CMAKE_COMMAND} -E chdir ${WORK_DIR} ${examples}/${command})
  endforeach()
  foreach(file IN ITEMS viewshed.tif viewshed.png segments.tif profile.svg cameras/sites.csv cameras/best-server.tif
      served/premises.csv served/premises.gpkg)
    if(NOT EXISTS ${WORK_DIR}/${file})
      message(FATAL_ERROR "the examples did not write ${file}")
    endif()
  endforeach()
  # What the program writes of the same is the same.
  itin(los town.itin --links links.csv --themes none -o program.csv)
  run(${CMAKE_COMMAND} -E compare_files ${WORK_DIR}/judged.csv ${WORK_DIR}/program.csv)
  itin(ztv town.itin --turbines turbines.csv --themes none -o program-zone)
  foreach(file IN ITEMS tip-count.tif areas.csv turbines.csv radius-preset.json)
    run(${CMAKE_COMMAND} -E compare_files ${WORK_DIR}/zone/${file} ${WORK_DIR}/program-zone/${file})
  endforeach()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
set(flags "${CXX_FLAGS}")
if(SANITIZE)
  string(APPEND flags " -fsanitize=${SANITIZE}")
endif()
set(settings -G Ninja -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
  -DCMAKE_CXX_COMPILER_LAUNCHER=${CXX_LAUNCHER} -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=${CXX_FLAGS_RELWITHDEBINFO})
set(foreign "")
if(SHARED)
  run(${CMAKE_COMMAND} -S ${ROOT_DIR} -B ${BUILD_DIR} ${settings} -DCMAKE_CXX_FLAGS=${CXX_FLAGS} -DBUILD_SHARED_LIBS=ON
    -DCMAKE_UNITY_BUILD=${UNITY_BUILD} -DITIN_SANITIZE=${SANITIZE} -DITIN_PARALLEL=${PARALLEL} -DITIN_BUILD_TESTS=OFF
    -DITIN_CHECK_PRECONDITIONS=${CHECK_PRECONDITIONS})
  run(${CMAKE_COMMAND} --build ${BUILD_DIR})
  # Users of shared libraries need not have what these were built with.
  foreach(package IN ITEMS CGAL GDAL GEOS SQLite3 OpenSSL TBB embree fmt PkgConfig)
    list(APPEND foreign -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
  endforeach()
endif()
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/installed)
# Whoever unpacks an installation elsewhere must find it whole.
file(RENAME ${WORK_DIR}/installed ${WORK_DIR}/prefix)
set(prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} -E chdir ${WORK_DIR} ${prefix}/bin/itin --version)
foreach(file IN ITEMS man/man1/itin.1.gz man/man1/itin-viewshed.1.gz bash-completion/completions/itin
    zsh/site-functions/_itin fish/vendor_completions.d/itin.fish)
  if(NOT EXISTS ${prefix}/share/${file})
    message(FATAL_ERROR "share/${file} is not installed")
  endif()
endforeach()
file(GLOB libraries ${prefix}/lib/libitin*.so.?.?.?)
list(LENGTH libraries count)
if(SHARED AND NOT count EQUAL 3)
  message(FATAL_ERROR "${count} shared libraries are installed")
endif()
foreach(library IN LISTS libraries)
  check_symbols(${library})
endforeach()
if(NOT SANITIZE)
  check_pkgconfig()
endif()
foreach(project IN ITEMS tests/consumer examples)
  if(SHARED AND project STREQUAL tests/consumer)
    continue()  # its headers are the same
  endif()
  run(${CMAKE_COMMAND} -S ${ROOT_DIR}/${project} -B ${WORK_DIR}/${project} ${settings} ${foreign}
    -DCMAKE_PREFIX_PATH=${prefix} "-DCMAKE_CXX_FLAGS=${flags} -Wall -Wextra -Werror")
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/${project})
endforeach()
if(NOT SHARED)
  run(${CMAKE_COMMAND} -E chdir ${WORK_DIR} ${WORK_DIR}/tests/consumer/consumer)
endif()
run_examples(${WORK_DIR}/examples)
run_guide(${settings} ${foreign} -DCMAKE_PREFIX_PATH=${prefix} "-DCMAKE_CXX_FLAGS=${flags} -Wall -Wextra -Werror")
