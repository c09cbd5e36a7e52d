# markervp_add_design(NAME SOURCES a.cpp… [LIBRARIES l…])
# A design: a shared object that `markervp run --design FILE` loads. What it uses of the platform it finds in the process
# that loads it, so that both have the same.
function(markervp_add_design NAME)
  cmake_parse_arguments(DESIGN "" "" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT DESIGN_SOURCES OR DESIGN_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "markervp_add_design(${NAME} SOURCES file… [LIBRARIES library…]): "
      "got '${ARGN}'")
  endif()
  add_library(${NAME} MODULE ${DESIGN_SOURCES})
  target_link_libraries(${NAME} PRIVATE markervp::design ${DESIGN_LIBRARIES})
  # Numbers are the same on every host.
  target_compile_options(${NAME} PRIVATE -ffp-contract=off)
  set_target_properties(${NAME} PROPERTIES PREFIX "" SUFFIX .so)
endfunction()
