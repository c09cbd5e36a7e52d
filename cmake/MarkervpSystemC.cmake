# SystemC comes from the system through pkg-config. Debian's package has no CMake files.
find_package(PkgConfig REQUIRED)
pkg_check_modules(SYSTEMC IMPORTED_TARGET GLOBAL systemc tlm)
if(NOT SYSTEMC_FOUND)
  message(FATAL_ERROR
    "SystemC was not found by pkg-config (systemc.pc, tlm.pc).\n"
    "Install it with 'scripts/setup' or 'apt-get install libsystemc-dev', "
    "or point PKG_CONFIG_PATH at your own build.")
endif()
pkg_get_variable(SYSTEMC_LIBDIR systemc libdir)
find_library(SYSTEMC_LIBRARY systemc HINTS ${SYSTEMC_LIBDIR} ${SYSTEMC_LIBRARY_DIRS} REQUIRED)

# A pthread-built SystemC runs every SC_THREAD on a host thread: twenty times slower, and our stack checks do not hold.
find_program(NM_PROGRAM NAMES nm ${CMAKE_NM} REQUIRED)
execute_process(COMMAND ${NM_PROGRAM} -D --undefined-only "${SYSTEMC_LIBRARY}"
                OUTPUT_VARIABLE systemc_symbols ERROR_QUIET)
if(systemc_symbols MATCHES "pthread_(create|cond_wait|cond_signal)")
  message(FATAL_ERROR
    "${SYSTEMC_LIBRARY} was built with pthreads for its processes. markervp needs QuickThreads "
    "(configure SystemC without --enable-pthreads); Debian's libsystemc is built so.")
endif()
add_library(markervp_systemc INTERFACE)
target_link_libraries(markervp_systemc INTERFACE PkgConfig::SYSTEMC)
target_compile_definitions(markervp_systemc INTERFACE SC_INCLUDE_DYNAMIC_PROCESSES)
set_target_properties(PkgConfig::SYSTEMC PROPERTIES
  INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${SYSTEMC_INCLUDE_DIRS}")
