# The Debian package that `scripts/package` makes (CPack): what `cmake --install` puts below a prefix, below /usr.
# The target `manual` makes a manual page for each command from its --help.
find_program(HELP2MAN_PROGRAM help2man)
set(manual_folder "${PROJECT_BINARY_DIR}/manual")
file(MAKE_DIRECTORY "${manual_folder}")
if(HELP2MAN_PROGRAM)
  add_custom_target(manual
    COMMAND "${CMAKE_COMMAND}" "-DMARKERVP=$<TARGET_FILE:markervp>" "-DHELP2MAN=${HELP2MAN_PROGRAM}"
      "-DVERSION=${PROJECT_VERSION}" "-DFOLDER=${manual_folder}" -P "${PROJECT_SOURCE_DIR}/cmake/manual.cmake"
    VERBATIM)
  add_dependencies(manual markervp)
endif()
install(DIRECTORY "${manual_folder}/" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME markervp)
set(CPACK_PACKAGE_CONTACT "The markervp authors <markervp@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/package")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION electronics)
# Libraries that the executable is linked with are found by dpkg-shlibdeps.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For designs, PS programs and platforms of one's own.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++, cmake, pkg-config, libsystemc-dev, libeigen3-dev, nlohmann-json3-dev, gtkwave")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "gdb, gcc-arm-none-eabi, qemu-system-arm, slurm-wlm, sqlite3")
include(CPack)
