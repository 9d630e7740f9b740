# `cmake --install`, find_package(strataflow) and a Debian package.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS strataflow tet_worker RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/strataflow/configs)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/strataflow-config.cmake.in
  ${PROJECT_BINARY_DIR}/strataflow-config.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/strataflow
  PATH_VARS CMAKE_INSTALL_BINDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/strataflow-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/strataflow-config.cmake ${PROJECT_BINARY_DIR}/strataflow-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/strataflow)

set(CPACK_PACKAGE_NAME strataflow)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "strataflow developers")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
include(CPack)
