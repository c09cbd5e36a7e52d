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

# markervp_add_program_test(NAME test SCRIPT test_x.py PROGRAM target) runs the tests of a Python file with pytest, and the program
# in them: the fixture `board` starts it (docs/software.md). JUnit: <test>.xml beside the build. Without SCRIPT the test is that
# `markervp run` ends well; ARGUMENTS go to it.
function(markervp_add_program_test)
  cmake_parse_arguments(TEST "" "NAME;SCRIPT;PROGRAM" "ARGUMENTS" ${ARGN})
  if(NOT TEST_NAME OR NOT TEST_PROGRAM OR TEST_UNPARSED_ARGUMENTS OR (TEST_SCRIPT AND TEST_ARGUMENTS))
    message(FATAL_ERROR "markervp_add_program_test(NAME test PROGRAM target [SCRIPT test_x.py | ARGUMENTS …]): got '${ARGN}'")
  endif()
  if(PROJECT_NAME STREQUAL "markervp")
    set(markervp $<TARGET_FILE:markervp>)
    set(modules "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../python")
  else()
    set(markervp $<TARGET_FILE:markervp::markervp>)
    set(modules "${markervp_PYTHON}")
  endif()
  if(NOT TEST_SCRIPT)
    add_test(NAME ${TEST_NAME} COMMAND "${markervp}" run --program $<TARGET_FILE:${TEST_PROGRAM}> --no-pictures --no-report
      --output ${TEST_NAME}.out ${TEST_ARGUMENTS})
    return()
  endif()
  find_program(MARKERVP_PYTEST NAMES pytest-3 pytest REQUIRED DOC "pytest, Debian's python3-pytest")
  cmake_path(ABSOLUTE_PATH TEST_SCRIPT)
  add_test(NAME ${TEST_NAME} COMMAND "${MARKERVP_PYTEST}" -q -p markervp_pytest -p no:cacheprovider
    --junitxml=${TEST_NAME}.xml "${TEST_SCRIPT}")
  set_tests_properties(${TEST_NAME} PROPERTIES ENVIRONMENT
    "MARKERVP=${markervp};MARKERVP_PROGRAM=$<TARGET_FILE:${TEST_PROGRAM}>;PYTHONPATH=${modules};PYTHONDONTWRITEBYTECODE=1")
endfunction()
