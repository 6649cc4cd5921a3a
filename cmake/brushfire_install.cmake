# install(), the package files for find_package(brushfire), and nothing else.
include(CMakePackageConfigHelpers)

install(TARGETS brushfire EXPORT brushfire_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY src/brushfire DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h" PATTERN "detail" EXCLUDE)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/generated/brushfire/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/brushfire)
install(EXPORT brushfire_targets NAMESPACE brushfire:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brushfire)
configure_package_config_file(cmake/brushfireConfig.cmake.in brushfireConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brushfire)
write_basic_package_version_file(brushfireConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/brushfireConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/brushfireConfigVersion.cmake
  cmake/FindDraco.cmake cmake/FindLZ4.cmake cmake/FindLibZip.cmake
  cmake/FindMeshoptimizer.cmake cmake/FindWebP.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/brushfire)
