# Packages for Debian, one for each component of the installation: cpack makes them, scripts/package does all of it.
option(ITIN_PACKAGES "Prepare packages for Debian" OFF)
if(NOT ITIN_PACKAGES)
  return()
endif()

set(package_of_program itin)
set(package_of_development libitin-dev)
set(package_of_python python3-itin)
set(package_of_qgis qgis-plugin-itin)
set(components program development)
if(ITIN_BUILD_PYTHON)
  list(APPEND components python)
endif()
# The plugin for QGIS needs no build.
set(qgis_plugin ${PROJECT_SOURCE_DIR}/bindings/qgis/itin_qgis)
if(EXISTS ${qgis_plugin}/metadata.txt)
  list(APPEND components qgis)
  install(DIRECTORY ${qgis_plugin} DESTINATION ${CMAKE_INSTALL_DATADIR}/qgis/python/plugins COMPONENT qgis
    PATTERN __pycache__ EXCLUDE PATTERN .mypy_cache EXCLUDE)
endif()

# Returns the packages that these files, or what they are links to, belong to on this machine.
function(itin_packages_of files packages)
  set(result "")
  foreach(file IN LISTS files)
    file(REAL_PATH ${file} file)
    execute_process(COMMAND dpkg-query --search ${file} OUTPUT_VARIABLE found COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX REPLACE "[:,].*" "" found "${found}")
    list(APPEND result ${found})
  endforeach()
  list(REMOVE_DUPLICATES result)
  list(JOIN result ", " result)
  set(${packages} "${result}" PARENT_SCOPE)
endfunction()

# What every package says of itself in share/doc. The program has parts of others in its live map, with their licences.
set(gzipped ${PROJECT_BINARY_DIR}/packages/changelog.Debian.gz)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
execute_process(COMMAND gzip --best --no-name --stdout ${CMAKE_CURRENT_LIST_DIR}/changelog OUTPUT_FILE ${gzipped}
  COMMAND_ERROR_IS_FATAL ANY)
set(vendored ${PROJECT_SOURCE_DIR}/cli/serve/page/vendor/LICENSES.txt)
file(READ ${CMAKE_CURRENT_LIST_DIR}/copyright copyright)
file(READ ${vendored} licences)
set(copyright_of_development ${CMAKE_CURRENT_LIST_DIR}/copyright)
set(copyright_of_python ${CMAKE_CURRENT_LIST_DIR}/copyright)
set(copyright_of_qgis ${CMAKE_CURRENT_LIST_DIR}/copyright)
set(copyright_of_program ${PROJECT_BINARY_DIR}/packages/copyright)
file(WRITE ${copyright_of_program} "${copyright}\nThe page of the live map has in it:\n\n${licences}")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/changelog
  ${CMAKE_CURRENT_LIST_DIR}/copyright ${vendored})
foreach(component IN LISTS components)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${package_of_${component}})
  install(FILES ${gzipped} ${copyright_of_${component}} DESTINATION ${folder} COMPONENT ${component})
endforeach()
install(DIRECTORY examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libitin-dev/examples COMPONENT development
  PATTERN python EXCLUDE PATTERN __pycache__ EXCLUDE)
install(DIRECTORY examples/python/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-itin/examples COMPONENT python
  PATTERN __pycache__ EXCLUDE)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME itin)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package begins with its own
set(CPACK_PACKAGE_CONTACT "itin maintainers <maintainers@users.noreply.h-seed-a3184b5d.example>")
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS OFF)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)

# The program. Libraries that it loads late are none of those that dpkg-shlibdeps finds (libitin/package/late.cmake).
get_property(late_libraries GLOBAL PROPERTY ITIN_LATE_LIBRARIES)
list(REMOVE_DUPLICATES late_libraries)
itin_packages_of("${late_libraries}" late_packages)
set(version "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/changelog newest LIMIT_COUNT 1)
if(NOT newest MATCHES "^itin \\(${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}\\)")
  message(FATAL_ERROR "packages/changelog begins with another version: ${newest}")
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME itin)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "${late_packages}, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-itin, xdg-utils")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "viewsheds, lines of sight and sites for masts over real terrain
itin computes what can be seen from where over real terrain, with buildings
and trees: viewsheds, lines of sight, radio links, zones of visibility of
wind farms, and the best sites for masts. Its answers are exact for the
surface that it stores. It reads rasters, LAS and LAZ, contours, footprints
and CityJSON, and writes GeoTIFF, GeoPackage, maps and reports. A live map
in the browser shows what a mast sees while it is dragged about.")

# The libraries, which are static; a program that is linked with them needs what they were built with.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libitin-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "itin ${version}, libgdal-dev, libgeos-dev, libsqlite3-dev, libzstd-dev, \
libxxhash-dev, libssl-dev, libcgal-dev, libfmt-dev, libtbb-dev, libembree-dev, libcairo2-dev, pkg-config")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "C++ libraries for viewsheds on a multiscale implicit TIN
The static libraries of itin and their headers: a store of terrain with what
stands on it, triangulations of any window at any tolerance, viewsheds,
profiles, lines of sight, radio links, and the choice of sites. CMake finds
them by find_package(itin), and pkg-config knows them as well.")

# The Python package.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-itin)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
if(ITIN_BUILD_PYTHON)
  execute_process(COMMAND /usr/bin/python3 -c "import sys; print('%d %d' % sys.version_info[:2])"
    OUTPUT_VARIABLE python OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^([0-9]+) ([0-9]+)$" python "${python}")
  set(minor ${CMAKE_MATCH_2})
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "itin ${version}, python3 (>= 3.${minor}~), python3 (<< 3.${next}), python3-numpy, fonts-dejavu-core")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS
  "python3-xarray, python3-rasterio, python3-geopandas, python3-matplotlib, python3-distributed")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/python3-itin/postinst
  ${CMAKE_CURRENT_LIST_DIR}/python3-itin/prerm)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "viewsheds, lines of sight and sites for masts in Python
The Python package itin calls the libraries that the command line calls, and
its results are the command line's, to the byte. Arrays come as NumPy arrays,
and viewsheds as datasets of xarray. It is typed. The program itin-dask runs
jobs of itin on many machines.")

# The plugin.
set(CPACK_DEBIAN_QGIS_PACKAGE_NAME qgis-plugin-itin)
set(CPACK_DEBIAN_QGIS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_QGIS_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_QGIS_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_QGIS_PACKAGE_DEPENDS "itin ${version}, qgis (>= 3.22)")
set(CPACK_DEBIAN_QGIS_DESCRIPTION "viewsheds, lines of sight and sites for masts in QGIS
A provider of Processing algorithms for QGIS that runs itin: import of
terrain and of what stands on it, viewsheds, radio coverage, lines of sight,
links, wind turbines, and the choice of sites, with styled layers.")

include(CPack)
