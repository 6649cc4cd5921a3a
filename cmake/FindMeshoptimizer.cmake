# Finds libmeshoptimizer (libmeshoptimizer-dev): Meshoptimizer::meshoptimizer, Meshoptimizer_FOUND.
find_path(Meshoptimizer_INCLUDE_DIR meshoptimizer.h)
find_library(Meshoptimizer_LIBRARY meshoptimizer)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Meshoptimizer REQUIRED_VARS Meshoptimizer_LIBRARY Meshoptimizer_INCLUDE_DIR)
if(Meshoptimizer_FOUND AND NOT TARGET Meshoptimizer::meshoptimizer)
  add_library(Meshoptimizer::meshoptimizer UNKNOWN IMPORTED)
  set_target_properties(Meshoptimizer::meshoptimizer PROPERTIES IMPORTED_LOCATION ${Meshoptimizer_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${Meshoptimizer_INCLUDE_DIR})
endif()
mark_as_advanced(Meshoptimizer_INCLUDE_DIR Meshoptimizer_LIBRARY)
