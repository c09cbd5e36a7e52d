# What `cmake --install` puts where, and the CMake package. Included last: it looks at targets of all folders.
#   bin/markervp               the executable
#   lib/markervp/              its plug-ins; programs/ has the PS programs that it finds by name
#   lib/libmarkervp_*.a        the libraries
#   include/markervp/<root>/   one include root for each layer, as in the source tree
#   lib/cmake/markervp/        find_package(markervp)
#   share/markervp/            examples/ are to copy; rtl/ has the IP in SystemVerilog; chip/ builds programs for the chip;
#                              markervp.gdb has commands for gdb
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/markervp")
set(header_folder "${CMAKE_INSTALL_INCLUDEDIR}/markervp")
set(data_folder "${CMAKE_INSTALL_DATADIR}/markervp")

# Exports markervp_<NAME> as markervp::<NAME>, here as in the package. ROOT: of its headers, below include/markervp; one or more.
function(markervp_export NAME)
  cmake_parse_arguments(LIBRARY "" "COMPONENT" "ROOT" ${ARGN})
  set(target markervp_${NAME})
  add_library(markervp::${NAME} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${NAME})
  # The folders of the source tree are of no use to others.
  get_target_property(folders ${target} INTERFACE_INCLUDE_DIRECTORIES)
  if(folders)
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "$<BUILD_INTERFACE:${folders}>")
  endif()
  set(includes "")
  if(LIBRARY_ROOT)
    list(TRANSFORM LIBRARY_ROOT PREPEND "${header_folder}/")
    set(includes INCLUDES DESTINATION ${LIBRARY_ROOT})
  endif()
  install(TARGETS ${target} EXPORT markervp_${LIBRARY_COMPONENT} ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" ${includes})
endfunction()

# For PS programs: no more than they see in the source tree.
markervp_export(register_description COMPONENT programs ROOT registers)
markervp_export(registers COMPONENT programs ROOT registers)
markervp_export(hal COMPONENT programs ROOT hal)
markervp_export(drivers COMPONENT programs ROOT sw compat)
markervp_export(marker COMPONENT programs ROOT sw)
markervp_export(compat COMPONENT programs ROOT compat)
markervp_export(apps_common COMPONENT programs ROOT sw)
markervp_export(hybrid COMPONENT programs ROOT sw)
# For platforms.
markervp_export(systemc COMPONENT designs)
markervp_export(eigen COMPONENT designs)
markervp_export(wave COMPONENT models ROOT vp)
markervp_export(vp COMPONENT models ROOT vp)
markervp_export(board COMPONENT models ROOT models)
markervp_export(xilinx COMPONENT models ROOT models)
markervp_export(pl_cores COMPONENT models ROOT models)
markervp_export(pl COMPONENT models ROOT models)
markervp_export(axi COMPONENT models ROOT models)
markervp_export(ps COMPONENT models ROOT models)
markervp_export(host COMPONENT models)
markervp_export(device COMPONENT models ROOT platform)
markervp_export(processing_system COMPONENT models ROOT platform)
# For designs: headers only. The code is in the executable.
add_library(markervp_design INTERFACE)
find_package(nlohmann_json REQUIRED)
target_link_libraries(markervp_design INTERFACE markervp_systemc markervp_eigen nlohmann_json::nlohmann_json)
target_compile_definitions(markervp_design INTERFACE MARKERVP_VERSION="${PROJECT_VERSION}")
markervp_export(design COMPONENT designs ROOT registers hal sw models vp platform)
# What the headers ask of those who include them.
foreach(library apps_common drivers hybrid marker wave vp)
  target_compile_features(markervp_${library} PUBLIC cxx_std_17)
endforeach()

# Headers of the folder FROM, and what lies below but for the folders named SKIP, into the include root ROOT.
function(markervp_install_headers FROM ROOT)
  cmake_parse_arguments(HEADERS "" "" "SKIP" ${ARGN})
  set(skip "")
  foreach(name IN LISTS HEADERS_SKIP)
    list(APPEND skip PATTERN "${name}" EXCLUDE)
  endforeach()
  install(DIRECTORY "${FROM}" DESTINATION "${header_folder}/${ROOT}" FILES_MATCHING PATTERN "*.h" ${skip})
endfunction()

get_target_property(register_folders markervp_registers INTERFACE_INCLUDE_DIRECTORIES)
string(REGEX REPLACE "^\\$<BUILD_INTERFACE:(.*)>$" "\\1" register_folders "${register_folders}")
foreach(folder IN LISTS register_folders)
  markervp_install_headers("${folder}/" registers)
endforeach()
markervp_install_headers(vp/registers/include/ registers)
markervp_install_headers(vp/include/ vp)
foreach(group axi board pl ps xilinx)
  markervp_install_headers(models/${group} models SKIP registers)
endforeach()
markervp_install_headers(sw/hal/include/ hal)
markervp_install_headers(sw/hal/compat/include/ compat)
markervp_install_headers("${PROJECT_BINARY_DIR}/sw/hal/compat/refused/" compat)
markervp_install_headers(sw/drivers sw)
markervp_install_headers(sw/marker sw)
markervp_install_headers(sw/apps/common sw/apps)
markervp_install_headers(sw/apps/hybrid sw/apps)
foreach(wing chip facts fpga marker result trace)
  markervp_install_headers(platform/${wing} platform
    SKIP commands detectors linux_app page picture power synthesis validation)
endforeach()

install(TARGETS hybrid improved ps-only blink two-cores exercise notebook LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/markervp/programs")
install(DIRECTORY examples DESTINATION "${data_folder}")
install(DIRECTORY sw/freertos/ DESTINATION "${data_folder}/freertos")
# The IP in SystemVerilog, a folder each.
file(GLOB rtl_files CONFIGURE_DEPENDS models/pl/*/rtl/*.sv)
foreach(file IN LISTS rtl_files)
  string(REGEX REPLACE "^.*/([a-z_]+)/rtl/[^/]+$" "\\1" ip "${file}")
  install(FILES "${file}" DESTINATION "${data_folder}/rtl/${ip}")
endforeach()
# The chip has a compiler of its own: what a program needs there is installed as source.
install(DIRECTORY sw/chip/ DESTINATION "${data_folder}/chip")
install(DIRECTORY sw/hal sw/marker sw/drivers DESTINATION "${data_folder}/chip/source/sw")
foreach(folder IN LISTS register_folders)
  cmake_path(NORMAL_PATH folder)
  cmake_path(RELATIVE_PATH folder BASE_DIRECTORY "${PROJECT_SOURCE_DIR}" OUTPUT_VARIABLE place)
  install(DIRECTORY "${folder}/" DESTINATION "${data_folder}/chip/source/${place}")
endforeach()
install(FILES models/registers/CMakeLists.txt DESTINATION "${data_folder}/chip/source/models/registers")
install(DIRECTORY vp/registers DESTINATION "${data_folder}/chip/source/vp")
install(FILES cmake/toolchain-arm-none-eabi.cmake cmake/MarkervpEigen.cmake cmake/MarkervpProgram.cpp.in DESTINATION "${data_folder}/chip/source/cmake")
install(FILES scripts/markervp.gdb DESTINATION "${data_folder}")
# Where Debian's Python looks for modules.
set(MARKERVP_PYTHON_FOLDER "lib/python3/dist-packages")
install(FILES python/markervp.py python/markervp_overlay.py python/markervp_pynq.py python/markervp_pytest.py
  python/markervp_registers.py DESTINATION "${MARKERVP_PYTHON_FOLDER}")
install(DIRECTORY traces/checks DESTINATION "${data_folder}")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")

foreach(component programs models designs)
  install(EXPORT markervp_${component} NAMESPACE markervp:: DESTINATION "${package_folder}"
    FILE markervp_${component}.cmake)
endforeach()
set(MARKERVP_RTL_FOLDER "${data_folder}/rtl")
set(MARKERVP_DEVICE_FOLDER "${CMAKE_INSTALL_LIBDIR}/markervp/devices")
configure_package_config_file(cmake/markervpConfig.cmake.in "${PROJECT_BINARY_DIR}/package/markervpConfig.cmake"
  INSTALL_DESTINATION "${package_folder}" PATH_VARS MARKERVP_DEVICE_FOLDER MARKERVP_RTL_FOLDER MARKERVP_PYTHON_FOLDER)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/package/markervpConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/package/markervpConfig.cmake"
  "${PROJECT_BINARY_DIR}/package/markervpConfigVersion.cmake"
  cmake/MarkervpDesign.cmake
  cmake/MarkervpProgram.cmake
  cmake/MarkervpRtl.cmake
  cmake/MarkervpProgram.cpp.in
  cmake/MarkervpCharge.cpp.in
  cmake/MarkervpAssembly.cpp
  cmake/MarkervpAssembly.h
  cmake/MarkervpHeap.cpp
  cmake/MarkervpRtl.cpp.in
  cmake/MarkervpRtlCells.cmake
  cmake/MarkervpRtlFiles.cmake
  cmake/MarkervpRtlRefused.cmake
  cmake/MarkervpVerilated.cmake
  cmake/MarkervpUnisim.cmake
  cmake/MarkervpVhdl.cmake
  cmake/MarkervpVhdlConstants.cmake
  cmake/MarkervpVendor.c
  cmake/MarkervpVendorDefaults.h
  cmake/MarkervpVendorRows.h
  DESTINATION "${package_folder}")
install(DIRECTORY models/xilinx/cells DESTINATION "${CMAKE_INSTALL_DATADIR}/markervp")
install(DIRECTORY sw/hal/freertos DESTINATION "${package_folder}")
