option(MARKERVP_SLOW_TESTS "Build the tests labelled slow with everything else" ON)
find_program(MOLD_PROGRAM mold)  # links more than a hundred programs in a tenth of the time
set(markervp_join "${CMAKE_CURRENT_LIST_DIR}/MarkervpJoin.cmake")

# Replaces the files *_test.cpp of the list SOURCES by joined ones of at most twelve each: MarkervpJoin.cmake has why. The others
# define what their headers declare, and stay.
function(_markervp_join_tests SOURCES NAME)
  set(tests ${${SOURCES}})
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(LENGTH tests count)
  if(NOT MARKERVP_UNITY OR count LESS 2)
    return()
  endif()
  set(sources ${${SOURCES}})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(TRANSFORM tests PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" REGEX "^[^/]")
  math(EXPR batches "(${count} + 11) / 12")
  foreach(batch RANGE 1 ${batches})
    math(EXPR first "(${batch} - 1) * ${count} / ${batches}")
    math(EXPR length "${batch} * ${count} / ${batches} - ${first}")
    list(SUBLIST tests ${first} ${length} joined)
    set(output "${CMAKE_CURRENT_BINARY_DIR}/${NAME}_${batch}.cpp")
    add_custom_command(OUTPUT "${output}" DEPENDS ${joined} "${markervp_join}"
      COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${output}" "-DSOURCES=${joined}" -P "${markervp_join}" VERBATIM)
    list(APPEND sources "${output}")
  endforeach()
  set(${SOURCES} ${sources} PARENT_SCOPE)
endfunction()

# markervp_add_test(NAME n [FREEZES] SOURCES a.cpp… [LIBRARIES l…] [LABELS slow] [COST seconds])
# One Boost.Test program, one CTest entry. LABELS slow: left out by `ctest -LE slow`. FREEZES: its PS programs fail, and are
# frozen where they stand; what their stacks hold is never given back, which the address sanitizer is not to count as leaks.
# COST: what takes a minute and more begins first, or one core waits at the end for the other.
function(markervp_add_test)
  cmake_parse_arguments(TEST "FREEZES" "NAME;COST" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  _markervp_join_tests(TEST_SOURCES ${TEST_NAME})
  add_executable(${TEST_NAME} ${TEST_SOURCES} $<TARGET_OBJECTS:markervp_test_main>
    $<TARGET_OBJECTS:markervp_address_sanitizer>)
  target_link_libraries(${TEST_NAME} PRIVATE ${TEST_LIBRARIES} Boost::unit_test_framework)
  target_compile_definitions(${TEST_NAME} PRIVATE BOOST_TEST_DYN_LINK
    MARKERVP_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data")
  if(MOLD_PROGRAM)
    target_link_options(${TEST_NAME} PRIVATE -fuse-ld=mold)
  endif()
  # Compiling costs more than running them: a third less than with -O1, of -O2 -g with sanitizers half.
  target_compile_options(${TEST_NAME} PRIVATE -O0 $<$<BOOL:${MARKERVP_SANITIZE}>:-g1>)
  add_test(NAME ${TEST_NAME} COMMAND ${TEST_NAME} --log_level=test_suite --report_level=short)
  set_tests_properties(${TEST_NAME} PROPERTIES TIMEOUT 1800)  # against hangs; sanitizers under load take long
  if(TEST_FREEZES)
    set_tests_properties(${TEST_NAME} PROPERTIES ENVIRONMENT "ASAN_OPTIONS=detect_leaks=0")
  endif()
  if(TEST_COST)
    set_tests_properties(${TEST_NAME} PROPERTIES COST ${TEST_COST})
  endif()
  if("slow" IN_LIST TEST_LABELS AND NOT MARKERVP_SLOW_TESTS)
    set_target_properties(${TEST_NAME} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  if(TEST_LABELS)
    set_tests_properties(${TEST_NAME} PROPERTIES LABELS "${TEST_LABELS}")
  endif()
endfunction()
