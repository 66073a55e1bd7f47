# Builds the program of the preset `release`. Where it is built, this takes a second.
execute_process(COMMAND ${CMAKE_COMMAND} --preset release -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
  -DCMAKE_CXX_COMPILER=${COMPILER} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build --preset release --target itin_cli COMMAND_ERROR_IS_FATAL ANY)
