# install(): the library with its public headers and licences, the package files for find_package(brushfire) and
# pkg-config, the program with its manual pages and completions.
include(CMakePackageConfigHelpers)

install(TARGETS brushfire EXPORT brushfire_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# Public is what brushfire.h includes, and nothing else is installed.
set(brushfire_headers_dir ${CMAKE_INSTALL_INCLUDEDIR}/brushfire)
install(FILES src/brushfire/brushfire.h DESTINATION ${brushfire_headers_dir})
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS src/brushfire/brushfire.h)
file(STRINGS src/brushfire/brushfire.h lines REGEX "^#(include <brushfire/|if |endif)")
set(part_is_there ON)
foreach(line ${lines})
  if(line MATCHES "^#if (.*)")
    set(part_is_there ${${CMAKE_MATCH_1}})
  elseif(line STREQUAL "#endif")
    set(part_is_there ON)
  endif()
  if(NOT line MATCHES "^#include" OR NOT part_is_there)
    continue()
  endif()
  string(REGEX REPLACE "^#include <brushfire/(.*)>$" "\\1" file "${line}")
  get_filename_component(room ${file} DIRECTORY)
  get_filename_component(header ${file} NAME)
  if(room STREQUAL "")
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/generated/brushfire/${header} DESTINATION ${brushfire_headers_dir})
  else()
    install(FILES src/brushfire/${room}/${header} DESTINATION ${brushfire_headers_dir}/${room})
  endif()
endforeach()

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/licenses/brushfire)
if(BRUSHFIRE_FIGURE)
  install(FILES src/brushfire/figure/font/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/licenses/brushfire RENAME LICENSE.DejaVu)
endif()

# Whoever links a static library links what it links. Of a shared one that is private, and no header shows it: its users
# need none of it installed. (pkg-config looks for what stands in Requires.private even for --cflags.)
get_target_property(type brushfire TYPE)
if(type STREQUAL "STATIC_LIBRARY")
  set(brushfire_pc_libraries " -pthread${BRUSHFIRE_PC_LIBRARIES}")
else()
  set(BRUSHFIRE_FIND_DEPENDENCIES "")
  set(BRUSHFIRE_PC_MODULES "")
  set(brushfire_pc_libraries "")
endif()

set(brushfire_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/brushfire)
install(EXPORT brushfire_targets NAMESPACE brushfire:: DESTINATION ${brushfire_cmake_dir})
configure_package_config_file(cmake/brushfireConfig.cmake.in brushfireConfig.cmake INSTALL_DESTINATION ${brushfire_cmake_dir})
write_basic_package_version_file(brushfireConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/brushfireConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/brushfireConfigVersion.cmake
  cmake/FindDraco.cmake cmake/FindLZ4.cmake cmake/FindLibZip.cmake cmake/FindMeshoptimizer.cmake cmake/FindWebP.cmake
  DESTINATION ${brushfire_cmake_dir})

# The prefix is told from where the file lies, so that the folder can be moved.
file(RELATIVE_PATH brushfire_pc_up /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
string(REGEX REPLACE "/$" "" brushfire_pc_up ${brushfire_pc_up})
configure_file(cmake/brushfire.pc.in brushfire.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/brushfire.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(BRUSHFIRE_BUILD_TOOLS)
  install(TARGETS brushfire_cli DESTINATION ${CMAKE_INSTALL_BINDIR})
  # What `brushfire view` puts meshes into, where `./run web` has built it.
  install(FILES web/dist-single/index.html DESTINATION ${CMAKE_INSTALL_DATADIR}/brushfire RENAME viewer.html OPTIONAL)
  # The program describes itself; where it cannot be run, because it is for another machine, it is installed bare.
  if(NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR)
    set(share ${CMAKE_CURRENT_BINARY_DIR}/share)
    file(MAKE_DIRECTORY ${share}/man/man1 ${share}/bash-completion/completions ${share}/zsh/site-functions
      ${share}/fish/vendor_completions.d)
    add_custom_command(OUTPUT ${share}/made
      COMMAND brushfire_cli manual --folder ${share}/man/man1
      COMMAND brushfire_cli completion bash > ${share}/bash-completion/completions/brushfire
      COMMAND brushfire_cli completion zsh > ${share}/zsh/site-functions/_brushfire
      COMMAND brushfire_cli completion fish > ${share}/fish/vendor_completions.d/brushfire.fish
      COMMAND ${CMAKE_COMMAND} -E touch ${share}/made
      DEPENDS brushfire_cli VERBATIM COMMENT "Manual pages and completions")
    add_custom_target(brushfire_share ALL DEPENDS ${share}/made)
    install(DIRECTORY ${share}/ DESTINATION ${CMAKE_INSTALL_DATADIR} PATTERN made EXCLUDE)
  endif()
endif()
