# markervp_add_program(NAME SOURCES a.cpp… [LIBRARIES l…])
# A PS program: a plug-in that `markervp run --program FILE` loads. It finds the HAL in the process that loads it.
# The same function builds the programs of sw/apps and those that use the installed package.
function(markervp_add_program NAME)
  cmake_parse_arguments(PROGRAM "" "" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT PROGRAM_SOURCES OR PROGRAM_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "markervp_add_program(${NAME} SOURCES file… [LIBRARIES library…]): "
      "got '${ARGN}'")
  endif()
  add_library(${NAME} MODULE ${PROGRAM_SOURCES})
  target_link_libraries(${NAME} PRIVATE markervp::hal ${PROGRAM_LIBRARIES})
  # Numbers as on the chip: no contraction.
  target_compile_options(${NAME} PRIVATE -ffp-contract=off)
  # The platform notices loops without HAL call by the basic blocks that run, and a stack that overflows by its guard page.
  target_compile_options(${NAME} PRIVATE
    "$<$<COMPILE_LANGUAGE:C,CXX>:-fsanitize-coverage=trace-pc;-fstack-clash-protection>")
  set_target_properties(${NAME} PROPERTIES PREFIX "" SUFFIX .so C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden)
  if(MARKERVP_PROGRAM_FOLDER)
    set_target_properties(${NAME} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${MARKERVP_PROGRAM_FOLDER}")
  endif()
endfunction()
