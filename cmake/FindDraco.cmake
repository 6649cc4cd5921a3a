# Finds libdraco (libdraco-dev): Draco::draco, Draco_FOUND.
find_path(Draco_INCLUDE_DIR draco/compression/decode.h)
find_library(Draco_LIBRARY draco)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Draco REQUIRED_VARS Draco_LIBRARY Draco_INCLUDE_DIR)
if(Draco_FOUND AND NOT TARGET Draco::draco)
  add_library(Draco::draco UNKNOWN IMPORTED)
  set_target_properties(Draco::draco PROPERTIES IMPORTED_LOCATION ${Draco_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${Draco_INCLUDE_DIR})
endif()
mark_as_advanced(Draco_INCLUDE_DIR Draco_LIBRARY)
