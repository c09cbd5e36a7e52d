# RTL that cannot be read: CMake stops, or, with STUB_IF_REFUSED of markervp_add_rtl(), the design has a stub in its place. The functions
# are parts of markervp_add_rtl() and see its arguments, RTL_…

# Stops, or leaves the reason where runs find it and gives NAME a target that builds nothing. ERRORS: what the program said, with its line
# end; what follows is the reason.
function(markervp_rtl_refuse NAME ERRORS)
  string(CONCAT reason ${ARGN})
  if(NOT RTL_STUB_IF_REFUSED)
    message(FATAL_ERROR "${ERRORS}markervp_add_rtl(${NAME}): ${reason}")
  endif()
  message(WARNING "${ERRORS}markervp_add_rtl(${NAME}): ${reason}\nThe design has a stub in its place, and verdicts that rest on it are unknown.")
  # What is first wrong, before the advice.
  string(REGEX REPLACE "[^\n]*:[0-9]+:[0-9]+:warning:[^\n]*" "" errors "${ERRORS}")
  if(errors MATCHES "(^|\n)%?(Error[^\n]*|[^\n]+:[0-9]+:[0-9]+:[^\n]*)")
    set(reason "${CMAKE_MATCH_2}; ${reason}")
  endif()
  file(REMOVE "${CMAKE_CURRENT_BINARY_DIR}/${NAME}.so")
  file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/${NAME}.refused" "${reason}\n")
  if(TARGET ${NAME})
    file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/${NAME}.rtl/glue.cpp" "")
    set_target_properties(${NAME} PROPERTIES EXCLUDE_FROM_ALL ON)
  else()
    add_custom_target(${NAME})
  endif()
endfunction()

# Ends the function that calls it.
macro(markervp_rtl_return_if_refused NAME)
  if(EXISTS "${CMAKE_CURRENT_BINARY_DIR}/${NAME}.refused")
    return()
  endif()
endmacro()

# VHDL into FILE. A process of its own, which can fail alone.
function(markervp_rtl_translate NAME FILE)
  find_program(GHDL_PROGRAM ghdl)
  if(NOT RTL_STUB_IF_REFUSED OR NOT GHDL_PROGRAM)
    markervp_rtl_from_vhdl(${NAME} ${RTL_TOP} "${FILE}" "${RTL_PARAMETERS}" "${RTL_GHDL_OPTIONS}" ${ARGN})
    return()
  endif()
  file(REMOVE "${FILE}.refused")
  markervp_rtl_folders("" "${RTL_INCLUDE_DIRS}" include_dirs)
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DNAME=markervp_add_rtl(${NAME})" "-DTOP=${RTL_TOP}" "-DFILE=${FILE}"
      "-DGENERICS=${RTL_PARAMETERS}" "-DOPTIONS=${RTL_GHDL_OPTIONS}" "-DSOURCES=${ARGN}" "-DRTL_INCLUDE_DIRS=${include_dirs}" -P "${markervp_rtl_vhdl}"
    RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(result EQUAL 0)
    return()
  endif()
  if(EXISTS "${FILE}.refused")
    file(READ "${FILE}.refused" said)
  endif()
  string(STRIP "${said}" said)
  string(FIND "${said}" "\n" end REVERSE)
  math(EXPR begin "${end} + 1")
  string(SUBSTRING "${said}" ${begin} -1 reason)
  string(SUBSTRING "${said}" 0 ${begin} said)
  string(REPLACE "markervp_add_rtl(${NAME}): " "" reason "${reason}")
  markervp_rtl_refuse(${NAME} "${said}" "${reason}")
endfunction()

set(markervp_rtl_vhdl "${CMAKE_CURRENT_LIST_DIR}/MarkervpVhdl.cmake")
