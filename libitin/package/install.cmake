# find_package(itin COMPONENTS itin viewshed profile) gives itin::itin, viewshed::viewshed and profile::profile.
# What is installed is of the component `program`, `development` or `python`; packages/packages.cmake makes a package of each.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)

set(ITIN_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/itin)
foreach(library IN ITEMS itin profile viewshed)
  set(target itin_${library})
  if(library STREQUAL itin)
    set(target itin)
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS ${target} EXPORT ${library}-targets)
  install(EXPORT ${library}-targets NAMESPACE ${library}:: DESTINATION ${ITIN_PACKAGE_DIR})
endforeach()
foreach(folder IN ITEMS libitin viewshed profile)
  install(DIRECTORY ${folder}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endforeach()
if(ITIN_BUILD_PROGRAM)
  install(TARGETS itin_cli COMPONENT program)
  install(PROGRAMS ${PROJECT_SOURCE_DIR}/bindings/dask/itin-dask TYPE BIN COMPONENT python)  # it is a script of Python
endif()

get_directory_property(ITIN_EMBREE_MAJOR DIRECTORY viewshed DEFINITION ITIN_EMBREE_MAJOR)
get_directory_property(ITIN_MODULE_DIR DIRECTORY viewshed DEFINITION ITIN_MODULE_DIR)
configure_package_config_file(libitin/package/itin-config.cmake.in itin-config.cmake INSTALL_DESTINATION ${ITIN_PACKAGE_DIR}
  PATH_VARS ITIN_MODULE_DIR)
write_basic_package_version_file(itin-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/itin-config.cmake ${PROJECT_BINARY_DIR}/itin-config-version.cmake
  DESTINATION ${ITIN_PACKAGE_DIR})

# pkg-config. The dependencies of static libraries are named library by library, as the static list of gdal.pc has all
# that GDAL itself was built with.
file(RELATIVE_PATH from_pc_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
function(itin_pkgconfig name library description requires libraries)
  if(BUILD_SHARED_LIBS)
    set(libraries "")
  endif()
  configure_file(libitin/package/pkgconfig.pc.in ${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
set(libraries "-lgdal -lgeos_c -lsqlite3 -lzstd -lxxhash -lcrypto -lgmp -lmpfr -lfmt")
if(ITIN_PARALLEL)
  string(APPEND libraries " -ltbb")
endif()
get_directory_property(have_pdal DIRECTORY libitin DEFINITION PDAL_FOUND)
if(have_pdal)
  string(APPEND libraries " -lpdalcpp")
endif()
itin_pkgconfig(itin itin "Multiscale implicit TINs" "" "${libraries}")
# Programs look in lib/itin for the module that draws maps.
itin_pkgconfig(itin-viewshed itin-viewshed "Viewsheds on a multiscale implicit TIN" itin-profile
  "-lembree${ITIN_EMBREE_MAJOR} -lfmt -ldl -Wl,-rpath,\${libdir}/itin")
itin_pkgconfig(itin-profile itin-profile "Lines of sight and radio links on a multiscale implicit TIN" itin
  "-lcairo -lfmt")
