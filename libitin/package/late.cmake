# Shared libraries that are loaded when they are first called: late_libraries.cpp says why. Each is named beside the
# target that links it.
function(itin_may_come_late)
  set_property(GLOBAL APPEND PROPERTY ITIN_LATE_LIBRARIES ${ARGN})
endfunction()

# Makes a program start without these libraries, where that is possible. `ARGN`: those of the program's objects that
# call them; the libraries of itin may call them, too.
function(itin_load_late target)
  get_property(late_libraries GLOBAL PROPERTY ITIN_LATE_LIBRARIES)
  list(REMOVE_DUPLICATES late_libraries)
  if(BUILD_SHARED_LIBS OR NOT CMAKE_SYSTEM_NAME STREQUAL Linux OR NOT CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64
      OR NOT late_libraries MATCHES "^([^;]*\\.so[^;]*;?)+$")
    return()
  endif()
  set(late ${PROJECT_SOURCE_DIR}/libitin/package)
  set(calls ${CMAKE_CURRENT_BINARY_DIR}/late_${target}/late.calls)
  set(callers $<TARGET_FILE:itin> $<TARGET_FILE:itin_viewshed> $<TARGET_FILE:itin_profile> ${ARGN})
  add_custom_command(OUTPUT ${calls} COMMAND ${late}/late_calls.sh ${calls} "$<JOIN:${callers}, >" ${late_libraries}
    DEPENDS ${callers} ${late}/late_calls.sh VERBATIM)
  target_sources(${target} PRIVATE ${late}/late_libraries.cpp ${calls})
  set_source_files_properties(${late}/late_libraries.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/late_${target})
  target_link_options(${target} PRIVATE LINKER:--as-needed)
endfunction()
