set(markervp_program_template "${CMAKE_CURRENT_LIST_DIR}/MarkervpProgram.cpp.in")
set(markervp_charge_template "${CMAKE_CURRENT_LIST_DIR}/MarkervpCharge.cpp.in")
set(markervp_program_heap "${CMAKE_CURRENT_LIST_DIR}/MarkervpHeap.cpp")
set(markervp_program_assembly "${CMAKE_CURRENT_LIST_DIR}/MarkervpAssembly")
set(markervp_vendor_folder "${CMAKE_CURRENT_LIST_DIR}")

# The folders of the vendor's drivers that VENDOR_BSP looks for: those whose devices are modelled are built, of the others a
# program finds the headers.
set(markervp_vendor_built axicdma axidma axivdma devcfg gpio gpiops iic iicps intc llfifo qspips scugic scutimer scuwdt spi spips sysmon
  tmrctr ttcps uartlite uartps vtc wdtps xadcps)
set(markervp_vendor_headers bram canps clk_wiz dmaps emacps sdps usbps)

# The folder with the sources of DRIVER below FOLDER, in SOURCE; empty if there is none.
function(_markervp_find_vendor_driver NAME FOLDER DRIVER SOURCE)
  set(place "${DRIVER}/src" "${DRIVER}_v*/src")
  set(found "")
  set(header "x${DRIVER}.h")
  if(DRIVER STREQUAL "xadcps")  # has its x already
    set(header "xadcps.h")
  endif()
  foreach(start "${FOLDER}" "${FOLDER}/libsrc" "${FOLDER}/*/libsrc" "${FOLDER}/XilinxProcessorIPLib/drivers")
    list(TRANSFORM place PREPEND "${start}/" OUTPUT_VARIABLE patterns)
    foreach(pattern IN LISTS patterns)
      file(GLOB headers "${pattern}/${header}")
      list(APPEND found ${headers})
    endforeach()
  endforeach()
  list(LENGTH found count)
  if(count GREATER 1)
    list(JOIN found ", " found)
    message(FATAL_ERROR "markervp_add_program(${NAME} … VENDOR_BSP '${FOLDER}'): which ${DRIVER}? There are ${found}: "
      "name the folder that holds one of them")
  endif()
  set(folder "")
  if(found)
    cmake_path(GET found PARENT_PATH folder)
  endif()
  set(${SOURCE} "${folder}" PARENT_SCOPE)
endfunction()

# Drivers of the vendor's in place of those of markervp::compat, from a copy that the user has: those that are found in
# FOLDER, the libsrc of a board support package or a checkout of the vendor's repository. Their release does not matter: what
# their records hold is seen in their headers.
function(_markervp_use_vendor_drivers NAME FOLDER)
  get_filename_component(folder "${FOLDER}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  if(NOT CMAKE_C_COMPILER)
    message(FATAL_ERROR "markervp_add_program(${NAME} … VENDOR_BSP): the vendor's drivers are C, write project(… LANGUAGES C CXX)")
  endif()
  set(drivers "")
  foreach(driver IN LISTS markervp_vendor_built markervp_vendor_headers)
    _markervp_find_vendor_driver(${NAME} "${folder}" ${driver} source)
    if(NOT source)
      continue()
    endif()
    target_include_directories(${NAME} BEFORE PRIVATE "${source}")
    if(driver IN_LIST markervp_vendor_headers)
      continue()
    endif()
    file(GLOB sources CONFIGURE_DEPENDS "${source}/*.c")
    list(FILTER sources EXCLUDE REGEX "_g\\.c$")  # the devices of another design
    set_source_files_properties(${sources} PROPERTIES COMPILE_OPTIONS "-w;-include;${markervp_vendor_folder}/MarkervpVendorDefaults.h")
    target_sources(${NAME} PRIVATE ${sources})
    string(TOUPPER "${driver}" upper)
    target_compile_definitions(${NAME} PRIVATE "MARKERVP_VENDOR_${upper}")
    foreach(field SgLengthWidth FifosDepth IntrId)
      file(GLOB headers "${source}/x*${driver}.h" "${source}/${driver}.h")
      list(GET headers 0 header)
      file(STRINGS "${header}" has REGEX "[ \t]${field};")
      if(has)
        string(TOUPPER "${field}" upper_field)
        target_compile_definitions(${NAME} PRIVATE "MARKERVP_HAS_${upper}_${upper_field}")
      endif()
    endforeach()
    if(driver STREQUAL "scugic")
      # How many interrupts there are, its releases before 2019 see by the compiler's processor: 95, or a Zynq UltraScale+'s 195.
      target_compile_definitions(${NAME} PRIVATE __ARM_NEON__)
    endif()
    list(APPEND drivers ${driver})
  endforeach()
  if(NOT drivers)
    list(JOIN markervp_vendor_built ", " names)
    message(FATAL_ERROR "markervp_add_program(${NAME} … VENDOR_BSP '${FOLDER}'): no driver of the vendor's is there. "
      "Name the libsrc of a board support package or a checkout of the vendor's repository; looked for "
      "${names}, each as <driver>/src/x<driver>.h or <driver>_v<version>/src/x<driver>.h")
  endif()
  set_source_files_properties("${markervp_vendor_folder}/MarkervpVendor.c" PROPERTIES
    COMPILE_OPTIONS "-w;-include;${markervp_vendor_folder}/MarkervpVendorDefaults.h")
  target_sources(${NAME} PRIVATE "${markervp_vendor_folder}/MarkervpVendor.c")
  list(JOIN drivers ", " drivers)
  message(STATUS "${NAME}: the vendor's drivers of ${drivers}")
endfunction()

# The kernel of FreeRTOS from a copy that the user has, with the port of this package. FOLDER has tasks.c, or its subfolder Source does.
# FreeRTOSConfig.h is the program's, or one like the vendor's tools make.
function(_markervp_use_freertos NAME FOLDER)
  get_filename_component(folder "${FOLDER}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  find_path(kernel tasks.c PATHS "${folder}" "${folder}/Source" NO_DEFAULT_PATH NO_CACHE)
  find_path(port port.c PATHS "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/freertos" "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../sw/hal/freertos"
    NO_DEFAULT_PATH NO_CACHE)
  if(NOT kernel OR NOT EXISTS "${kernel}/include/FreeRTOS.h")
    message(FATAL_ERROR "markervp_add_program(${NAME} … FREERTOS '${FOLDER}'): no kernel of FreeRTOS is there. "
      "Name a checkout of FreeRTOS-Kernel, which has tasks.c and include/FreeRTOS.h")
  endif()
  set(sources "${port}/port.c")
  foreach(part tasks list queue timers event_groups stream_buffer)
    list(APPEND sources "${kernel}/${part}.c")
  endforeach()
  if(NOT "${ARGN}" MATCHES "heap_[1-5]\\.c")
    list(APPEND sources "${kernel}/portable/MemMang/heap_4.c")
  endif()
  set_source_files_properties(${sources} PROPERTIES COMPILE_OPTIONS -w)
  target_sources(${NAME} PRIVATE ${sources})
  target_include_directories(${NAME} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}" "${kernel}/include" "${port}" "${port}/default")
endfunction()

# Sets VARIABLE to true if one of the sources defines hal_program_info, and so says what it does and counts its work.
function(_markervp_is_annotated VARIABLE)
  set(${VARIABLE} FALSE PARENT_SCOPE)
  foreach(source IN LISTS ARGN)
    cmake_path(ABSOLUTE_PATH source)
    if(NOT EXISTS "${source}")
      continue()
    endif()
    file(STRINGS "${source}" lines REGEX "hal_program_info")
    if(lines)
      set(${VARIABLE} TRUE PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# Headers that the sources name in another case, as a host that does not mind lets them: FOLDER gets one of that name for each, which
# includes the header beside the source or of the board support package.
function(_markervp_spell_headers NAME FOLDER)
  get_target_property(known markervp::compat INTERFACE_INCLUDE_DIRECTORIES)
  foreach(source IN LISTS ARGN)
    cmake_path(ABSOLUTE_PATH source)
    cmake_path(GET source PARENT_PATH folder)
    file(GLOB own "${folder}/*.h")
    if(EXISTS "${source}")
      list(APPEND own "${source}")
    endif()
    foreach(file IN LISTS own)
      file(STRINGS "${file}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"][^<>\"/]*[A-Z][^<>\"/]*[>\"]")
      foreach(line IN LISTS lines)
        string(REGEX REPLACE "^[^<\"]*[<\"]([^>\"]*).*" "\\1" name "${line}")
        string(TOLOWER "${name}" lower)
        find_file(there "${lower}" PATHS ${folder} ${known} NO_DEFAULT_PATH NO_CACHE)
        if(there AND NOT EXISTS "${folder}/${name}")
          file(CONFIGURE OUTPUT "${FOLDER}/${name}" CONTENT "#include \"${there}\"\n" @ONLY)
        endif()
        unset(there)
      endforeach()
    endforeach()
  endforeach()
  if(EXISTS "${FOLDER}")
    target_include_directories(${NAME} AFTER PRIVATE "${FOLDER}")
  endif()
endfunction()

# How the code of a program is compiled; ANNOTATED: it counts its work.
function(_markervp_compile_program NAME ANNOTATED)
  # Numbers as on the chip: no contraction. Messages name lines, and all who called: no call becomes a jump.
  target_compile_options(${NAME} PRIVATE -ffp-contract=off
    "$<$<COMPILE_LANGUAGE:C,CXX>:-g;-fno-optimize-sibling-calls>")
  # The platform notices loops without HAL call by the basic blocks that run, and a stack that overflows by its guard page.
  target_compile_options(${NAME} PRIVATE
    "$<$<COMPILE_LANGUAGE:C,CXX>:-fsanitize-coverage=trace-pc;-fstack-clash-protection>")
  # Its code takes time by what it is made of (ps.cpu.code_scale): the same at every optimisation of the build.
  if(NOT ANNOTATED)
    target_compile_options(${NAME} PRIVATE "$<$<COMPILE_LANGUAGE:C,CXX>:-O0>"
      "$<$<COMPILE_LANGUAGE:C,CXX>:SHELL:-include \"${markervp_program_assembly}.h\">"
      # Its data have 32-bit addresses here, too: casts of pointers to u32 are right.
      "$<$<COMPILE_LANGUAGE:C>:-Wno-pointer-to-int-cast;-Wno-int-to-pointer-cast>" "$<$<COMPILE_LANGUAGE:CXX>:-fpermissive>")
  endif()
endfunction()

# The program of the second core, which is an ELF file of its own on the chip: names of both do not meet. Core 1 starts it where the
# program writes an address at which it has no code.
function(_markervp_add_core1 NAME)
  set(core1 ${NAME}_core1)
  add_library(${core1} OBJECT ${ARGN})
  get_target_property(libraries ${NAME} LINK_LIBRARIES)
  target_link_libraries(${core1} PRIVATE ${libraries})
  target_include_directories(${core1} BEFORE PRIVATE "$<TARGET_PROPERTY:${NAME},INCLUDE_DIRECTORIES>")
  target_compile_definitions(${core1} PRIVATE "$<TARGET_PROPERTY:${NAME},COMPILE_DEFINITIONS>")
  _markervp_compile_program(${core1} FALSE)
  set_target_properties(${core1} PROPERTIES POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden)
  set(joined "${CMAKE_CURRENT_BINARY_DIR}/${core1}.o")
  add_custom_command(OUTPUT "${joined}" COMMAND_EXPAND_LISTS VERBATIM
    COMMAND "${CMAKE_LINKER}" -r -o "${joined}" "$<TARGET_OBJECTS:${core1}>"
    COMMAND "${CMAKE_OBJCOPY}" --redefine-sym main=markervp_core1_main --keep-global-symbol=markervp_core1_main "${joined}"
    DEPENDS ${core1} "$<TARGET_OBJECTS:${core1}>")
  set(entry "${CMAKE_CURRENT_BINARY_DIR}/${core1}.cpp")
  file(CONFIGURE OUTPUT "${entry}" CONTENT "extern \"C\" int markervp_core1_main();
extern \"C\" __attribute__((visibility(\"default\"))) void markervp_core1() {
  markervp_core1_main();
}
" @ONLY)
  set_source_files_properties("${joined}" PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
  target_sources(${NAME} PRIVATE "${entry}" "${joined}")
endfunction()

# Drivers as a library, as the vendor's tools make one of them: the program takes from it what it calls and does not define itself.
function(_markervp_add_drivers NAME)
  set(drivers ${NAME}_drivers)
  add_library(${drivers} STATIC ${ARGN})
  get_target_property(libraries ${NAME} LINK_LIBRARIES)
  target_link_libraries(${drivers} PRIVATE ${libraries})
  target_include_directories(${drivers} BEFORE PRIVATE "$<TARGET_PROPERTY:${NAME},INCLUDE_DIRECTORIES>")
  target_compile_definitions(${drivers} PRIVATE "$<TARGET_PROPERTY:${NAME},COMPILE_DEFINITIONS>")
  target_compile_options(${drivers} PRIVATE "$<TARGET_PROPERTY:${NAME},COMPILE_OPTIONS>")
  set_target_properties(${drivers} PROPERTIES POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden)
  target_link_libraries(${NAME} PRIVATE ${drivers})
endfunction()

# A PS program: a plug-in that `markervp run --program FILE` loads. It finds the HAL in the process that loads it. The sources
# define hal_program_info, or main(). Drivers of VENDOR_BSP stand on markervp::compat, which need not be named.
# markervp_add_program(NAME SOURCES a.cpp… [CORE1 b.c…] [DRIVERS d.c…] [LIBRARIES l…] [VENDOR_BSP FOLDER] [FREERTOS FOLDER])
# The same function builds the programs of sw/apps and those that use the installed package.
function(markervp_add_program NAME)
  cmake_parse_arguments(PROGRAM "" "VENDOR_BSP;FREERTOS" "SOURCES;CORE1;DRIVERS;LIBRARIES" ${ARGN})
  if(NOT PROGRAM_SOURCES OR PROGRAM_UNPARSED_ARGUMENTS OR "VENDOR_BSP" IN_LIST PROGRAM_KEYWORDS_MISSING_VALUES
     OR "FREERTOS" IN_LIST PROGRAM_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "markervp_add_program(${NAME} SOURCES file… [CORE1 file…] [DRIVERS file…] [LIBRARIES library…] [VENDOR_BSP folder] [FREERTOS folder]): "
      "got '${ARGN}'")
  endif()
  set(description "${CMAKE_CURRENT_BINARY_DIR}/${NAME}_program.cpp")
  _markervp_is_annotated(annotated ${PROGRAM_SOURCES} ${PROGRAM_CORE1})
  if(annotated AND PROGRAM_CORE1)
    message(FATAL_ERROR "markervp_add_program(${NAME} … CORE1 …): a program with hal_program_info has no second one. Start a function "
      "of it on core 1, with hal_cpu_start(1, function)")
  endif()
  set(MARKERVP_CHARGE "")
  if(NOT annotated)
    file(READ "${markervp_charge_template}" MARKERVP_CHARGE)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${markervp_charge_template}")
  endif()
  configure_file("${markervp_program_template}" "${description}" @ONLY)
  add_library(${NAME} MODULE ${PROGRAM_SOURCES} "${description}" "${markervp_program_heap}")
  target_link_libraries(${NAME} PRIVATE markervp::hal ${PROGRAM_LIBRARIES})
  if("markervp::compat" IN_LIST PROGRAM_LIBRARIES)
    _markervp_spell_headers(${NAME} "${CMAKE_CURRENT_BINARY_DIR}/${NAME}_headers" ${PROGRAM_SOURCES})
  endif()
  if(DEFINED PROGRAM_VENDOR_BSP)
    target_link_libraries(${NAME} PRIVATE markervp::compat)
    _markervp_use_vendor_drivers(${NAME} "${PROGRAM_VENDOR_BSP}")
  endif()
  if(DEFINED PROGRAM_FREERTOS)
    target_link_libraries(${NAME} PRIVATE markervp::compat)
    _markervp_use_freertos(${NAME} "${PROGRAM_FREERTOS}" ${PROGRAM_SOURCES})
  endif()
  _markervp_compile_program(${NAME} ${annotated})
  if(NOT annotated)
    target_sources(${NAME} PRIVATE "${markervp_program_assembly}.cpp")
  endif()
  if(PROGRAM_CORE1)
    _markervp_add_core1(${NAME} ${PROGRAM_CORE1})
  endif()
  if(PROGRAM_DRIVERS)
    _markervp_add_drivers(${NAME} ${PROGRAM_DRIVERS})
  endif()
  # It lies where the chip has it, so that any variable is a DMA buffer; its heap follows. Its malloc() and new are its own.
  target_link_options(${NAME} PRIVATE "LINKER:-Ttext-segment=0x00100000" "LINKER:-Bsymbolic-functions")
  # Built for gcov, it offers the function that writes the counters: they are static data, which the platform else restores.
  separate_arguments(flags NATIVE_COMMAND "${CMAKE_C_FLAGS} ${CMAKE_CXX_FLAGS}")
  string(REPLACE "," "$<COMMA>" flags "${flags}")  # -fsanitize=address,undefined
  set(options "$<TARGET_PROPERTY:${NAME},COMPILE_OPTIONS>;${flags}")
  target_link_options(${NAME} PRIVATE "$<$<IN_LIST:--coverage,${options}>:-Wl,-u,__gcov_dump>")
  set_target_properties(${NAME} PROPERTIES PREFIX "" SUFFIX .so C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden)
  if(MARKERVP_PROGRAM_FOLDER)
    set_target_properties(${NAME} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${MARKERVP_PROGRAM_FOLDER}")
  endif()
endfunction()

# markervp_add_program_test(NAME test SCRIPT test_x.py PROGRAM target) runs the tests of a Python file with pytest, and the program
# in them: the fixture `board` starts it (docs/program-tests.md). JUnit: <test>.xml beside the build. Without SCRIPT the test is that
# `markervp run` ends well. ARGUMENTS go to it, with SCRIPT to each run that names no options.
function(markervp_add_program_test)
  cmake_parse_arguments(TEST "" "NAME;SCRIPT;PROGRAM" "ARGUMENTS" ${ARGN})
  if(NOT TEST_NAME OR NOT TEST_PROGRAM OR TEST_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "markervp_add_program_test(NAME test PROGRAM target [SCRIPT test_x.py] [ARGUMENTS …]): got '${ARGN}'")
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
  list(TRANSFORM TEST_ARGUMENTS PREPEND --markervp=)
  add_test(NAME ${TEST_NAME} COMMAND "${MARKERVP_PYTEST}" -q -p markervp_pytest -p no:cacheprovider
    --junitxml=${TEST_NAME}.xml ${TEST_ARGUMENTS} "${TEST_SCRIPT}")
  set_tests_properties(${TEST_NAME} PROPERTIES ENVIRONMENT
    "MARKERVP=${markervp};MARKERVP_PROGRAM=$<TARGET_FILE:${TEST_PROGRAM}>;PYTHONPATH=${modules};PYTHONDONTWRITEBYTECODE=1")
endfunction()
