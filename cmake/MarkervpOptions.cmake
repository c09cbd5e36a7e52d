# What every target is compiled with. Numbers must be the same on every host: no contraction, no fast maths, no -march=native.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
set(CMAKE_INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

option(MARKERVP_SANITIZE "Build with address and undefined-behaviour sanitizers" OFF)
option(MARKERVP_WERROR "Treat warnings as errors" OFF)

# Several sources are compiled as one: a clean build takes a third of the time. What goes onto the chip (sw/) is compiled file by
# file.
option(MARKERVP_UNITY "Compile several sources at a time" ON)
set(CMAKE_UNITY_BUILD ${MARKERVP_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 12)

add_compile_options(-Wall -Wextra -ffp-contract=off)
# No function of ours is replaced at load time: the compiler may inline across them in spite of -fPIC.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-fno-semantic-interposition MARKERVP_HAS_NO_INTERPOSITION)
if(MARKERVP_HAS_NO_INTERPOSITION)
  add_compile_options(-fno-semantic-interposition)
endif()
if(MARKERVP_WERROR)
  add_compile_options(-Werror)
endif()
if(MARKERVP_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()
