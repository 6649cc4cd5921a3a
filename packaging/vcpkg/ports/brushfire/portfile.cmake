# BRUSHFIRE_SOURCE: an unpacked source tarball; a registry would fetch it with vcpkg_from_github() in its place.
if(DEFINED ENV{BRUSHFIRE_SOURCE})
  set(SOURCE_PATH "$ENV{BRUSHFIRE_SOURCE}")
else()
  get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../../.." ABSOLUTE)
endif()

vcpkg_check_features(OUT_FEATURE_OPTIONS options FEATURES
  formats BRUSHFIRE_WITH_ZLIB
  formats BRUSHFIRE_WITH_EXPAT
  formats BRUSHFIRE_WITH_LZ4
  formats BRUSHFIRE_WITH_LZMA
  formats BRUSHFIRE_WITH_LIBZIP
  formats BRUSHFIRE_WITH_DRACO
  formats BRUSHFIRE_WITH_MESHOPTIMIZER
  heat    BRUSHFIRE_WITH_EIGEN
  tools   BRUSHFIRE_BUILD_TOOLS
  webp    BRUSHFIRE_WITH_WEBP)

vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS ${options} -DBRUSHFIRE_BUILD_TESTS=OFF -DBRUSHFIRE_WITH_EMBREE=OFF -DFETCHCONTENT_FULLY_DISCONNECTED=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/brushfire)
vcpkg_fixup_pkgconfig()
if("tools" IN_LIST FEATURES)
  vcpkg_copy_tools(TOOL_NAMES brushfire AUTO_CLEAN)
endif()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE" "${SOURCE_PATH}/src/brushfire/figure/font/LICENSE")
