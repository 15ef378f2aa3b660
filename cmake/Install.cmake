# What `cmake --install` puts where, by the Filesystem Hierarchy Standard. gnomon finds its files at run time
# relative to itself (src/base/installation.cpp): a prefix may be moved as a whole.
include(CMakePackageConfigHelpers)

file(RELATIVE_PATH libraries_from_programs ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set_target_properties(gnomon PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries_from_programs}")
install(TARGETS gnomon RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS gnomon_library gnomon_interface EXPORT gnomonTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(GNOMON_MULTIGRID)
  install(TARGETS gnomon_multigrid LIBRARY DESTINATION libexec/gnomon)
endif()
if(GNOMON_GMSH)
  install(TARGETS gnomon_gmsh RUNTIME DESTINATION libexec/gnomon)
endif()

# The public headers and those that they include; no others are offered (docs/library.md).
foreach(header ${gnomon_public_headers} ${gnomon_included_headers})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/include/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder})
endforeach()

install(DIRECTORY problems/ DESTINATION share/gnomon/problems PATTERN "*.[ch]pp" EXCLUDE)
install(DIRECTORY tools/plot/ DESTINATION share/gnomon/plot PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN "conf.py" EXCLUDE PATTERN "_static" EXCLUDE)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(FILES ${PROJECT_BINARY_DIR}/interface.cpp DESTINATION share/gnomon/cmake)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)
configure_package_config_file(cmake/gnomonConfig.cmake.in ${PROJECT_BINARY_DIR}/gnomonConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT gnomonTargets NAMESPACE gnomon:: DESTINATION ${package_folder})
install(FILES ${PROJECT_BINARY_DIR}/gnomonConfig.cmake ${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake
              cmake/Dependencies.cmake DESTINATION ${package_folder})

# The man page and the completion of the shell are made by the program, from its command line and key tables.
set(manual ${PROJECT_BINARY_DIR}/gnomon.1)
set(completion ${PROJECT_BINARY_DIR}/gnomon.bash)
add_custom_command(OUTPUT ${manual} ${completion} DEPENDS gnomon VERBATIM
  COMMAND ${CMAKE_COMMAND} -E env GNOMON_PLUGINS= sh -c "\"$1\" help man-page > \"$2\" && \"$1\" help completion > \"$3\""
          make $<TARGET_FILE:gnomon> ${manual} ${completion})
add_custom_target(gnomon_manual ALL DEPENDS ${manual} ${completion})
install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${completion} DESTINATION share/bash-completion/completions RENAME gnomon)

# The Debian package: cpack -G DEB in the build folder.
# Installing takes what is built; cpack does not build tests.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the gnomon authors <gnomon@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libopenblas0-pthread, libeigen3-dev, python3-matplotlib, python3-h5py, python3-jinja2, python3-numpy")
include(CPack)
