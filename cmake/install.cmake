# SPDX-License-Identifier: Apache-2.0
# `make install` and `make deb`: the program, its data where it looks for them, documents, and sconce-runtime as a CMake package.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(data ${CMAKE_INSTALL_DATADIR}/sconce)
install(TARGETS sconce RUNTIME)
install(DIRECTORY scenes/ DESTINATION ${data}/scenes FILES_MATCHING PATTERN *.glb PATTERN *.toml)
install(DIRECTORY solvers DESTINATION ${data} USE_SOURCE_PERMISSIONS)
install(FILES src/import/sconce_blender.py DESTINATION ${data})
# The page, where `make web` has built it.
install(FILES ${CMAKE_BINARY_DIR}/web/index.html DESTINATION ${data}/web OPTIONAL)
install(DIRECTORY ${CMAKE_BINARY_DIR}/web/assets DESTINATION ${data}/web OPTIONAL)
install(FILES README.md CHANGELOG.md LICENSE THIRD_PARTY.md CONTRIBUTING.md TYPE DOC)
install(DIRECTORY docs TYPE DOC)
install(DIRECTORY examples TYPE DOC PATTERN CMakeLists.txt EXCLUDE)
install(FILES examples/find_package/CMakeLists.txt DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples/find_package)

install(TARGETS sconce-runtime EXPORT sconce LIBRARY)
install(FILES src/runtime/sconce.h TYPE INCLUDE)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/sconce)
install(EXPORT sconce NAMESPACE sconce:: FILE sconce-config.cmake DESTINATION ${package})
write_basic_package_version_file(sconce-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/sconce-config-version.cmake DESTINATION ${package})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "the authors of sconce <sconce@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "bakes light groups into lightmaps that are mixed afterwards")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
# What is opened at run time: OpenGL by libepoxy, letters of the window, .blend files.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1, libgl1")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libegl-mesa0, libgl1-mesa-dri, fonts-inter")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "blender, ffmpeg")
include(CPack)
