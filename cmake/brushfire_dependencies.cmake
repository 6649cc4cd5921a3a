# Third-party libraries. The library itself uses header-only ones, privately: nothing of them shows in its public headers
# or in its installed package.

# Boost headers (Polygon, Geometry, Multiprecision) as system headers: their warnings are not ours.
find_package(Boost 1.74 REQUIRED)
find_path(BRUSHFIRE_FAST_FLOAT_DIR fast_float/fast_float.h REQUIRED DOC "fast_float's headers (libfast-float-dev)")

# Sean Barrett's single-file libraries: PNG writing, TrueType.
find_path(BRUSHFIRE_STB_INCLUDE_DIR stb_image_write.h PATH_SUFFIXES stb REQUIRED DOC "stb's headers (libstb-dev)")

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)

# Compiled ones are optional: without them the library says which files it cannot read. A static brushfire passes them
# on to whoever links it, so the installed package looks for the same ones.
option(BRUSHFIRE_WITH_ZLIB "Read and write compressed files" ON)
set(BRUSHFIRE_FIND_DEPENDENCIES "")
if(BRUSHFIRE_WITH_ZLIB)
  find_package(ZLIB)
  if(ZLIB_FOUND)
    string(APPEND BRUSHFIRE_FIND_DEPENDENCIES "find_dependency(ZLIB)\n")
  endif()
endif()
option(BRUSHFIRE_WITH_WEBP "Write animations as WebP" ON)
if(BRUSHFIRE_WITH_WEBP)
  find_package(WebP)
  if(WebP_FOUND)
    string(APPEND BRUSHFIRE_FIND_DEPENDENCIES
      "list(APPEND CMAKE_MODULE_PATH \${CMAKE_CURRENT_LIST_DIR})\nfind_dependency(WebP)\n")
  endif()
endif()

# Links what was found to the library, privately.
function(brushfire_link_dependencies target)
  target_include_directories(${target} SYSTEM PRIVATE ${BRUSHFIRE_FAST_FLOAT_DIR} ${BRUSHFIRE_STB_INCLUDE_DIR})
  target_link_libraries(${target} PRIVATE Threads::Threads)
  if(BRUSHFIRE_WITH_ZLIB AND ZLIB_FOUND)
    target_link_libraries(${target} PRIVATE ZLIB::ZLIB)
    target_compile_definitions(${target} PRIVATE BRUSHFIRE_HAS_ZLIB)
  endif()
  if(BRUSHFIRE_WITH_WEBP AND WebP_FOUND)
    target_link_libraries(${target} PRIVATE WebP::libwebpmux)
    target_compile_definitions(${target} PRIVATE BRUSHFIRE_HAS_WEBP)
  endif()
endfunction()
