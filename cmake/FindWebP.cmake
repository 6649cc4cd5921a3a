# Finds libwebp and libwebpmux (libwebp-dev): WebP::libwebp, WebP::libwebpmux, WebP_FOUND.
find_path(WebP_INCLUDE_DIR webp/mux.h)
find_library(WebP_LIBRARY webp)
find_library(WebP_MUX_LIBRARY webpmux)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(WebP REQUIRED_VARS WebP_LIBRARY WebP_MUX_LIBRARY WebP_INCLUDE_DIR)
if(WebP_FOUND AND NOT TARGET WebP::libwebpmux)
  add_library(WebP::libwebp UNKNOWN IMPORTED)
  set_target_properties(WebP::libwebp PROPERTIES IMPORTED_LOCATION ${WebP_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${WebP_INCLUDE_DIR})
  add_library(WebP::libwebpmux UNKNOWN IMPORTED)
  set_target_properties(WebP::libwebpmux PROPERTIES IMPORTED_LOCATION ${WebP_MUX_LIBRARY}
    INTERFACE_LINK_LIBRARIES WebP::libwebp)
endif()
mark_as_advanced(WebP_INCLUDE_DIR WebP_LIBRARY WebP_MUX_LIBRARY)
