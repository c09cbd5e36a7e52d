# markervp_add_program(NAME SOURCES a.cpp… [LIBRARIES l…])
# A PS program: a plug-in that `markervp run --program FILE` loads. It finds the HAL in the process that loads it.
function(markervp_add_program NAME)
  cmake_parse_arguments(PROGRAM "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(${NAME} MODULE ${PROGRAM_SOURCES})
  target_link_libraries(${NAME} PRIVATE markervp_hal ${PROGRAM_LIBRARIES})
  set_target_properties(${NAME} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden
    LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib/markervp/programs")
endfunction()
