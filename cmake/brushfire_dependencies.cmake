# Third-party libraries. The library itself uses header-only ones, privately: nothing of them shows in its public headers
# or in its installed package. What the machine has is used; otherwise headers pinned by their commit are fetched.
include(FetchContent)

# brushfire_find_headers(VARIABLE HEADER OWNER/REPOSITORY COMMIT): the folder to include HEADER from.
function(brushfire_find_headers variable header repository commit)
  find_path(${variable} ${header} DOC "Where ${header} is")
  if(${variable})
    return()
  endif()
  message(STATUS "${header} is not installed: fetching ${repository}")
  FetchContent_Declare(${variable} URL https://github.com/${repository}/archive/${commit}.tar.gz)
  FetchContent_Populate(${variable})
  string(TOLOWER ${variable} name)
  set(${variable} ${${name}_SOURCE_DIR}/include CACHE PATH "Where ${header} is" FORCE)
endfunction()

# Boost headers (Polygon, Geometry, Multiprecision) as system headers: their warnings are not ours.
find_package(Boost 1.74 REQUIRED)
brushfire_find_headers(BRUSHFIRE_FAST_FLOAT_DIR fast_float/fast_float.h  # 6.1.6
  fastfloat/fast_float 00c8c7b0d5c722d2212568d915a39ea73b08b973)
brushfire_find_headers(BRUSHFIRE_JSON_DIR nlohmann/json.hpp  # 3.11.3
  nlohmann/json 9cca280a4d0ccf0c08f47a99aa71d1b0e52f8d03)
if(BRUSHFIRE_BUILD_TOOLS)
  brushfire_find_headers(BRUSHFIRE_CLI11_DIR CLI/CLI.hpp  # 2.4.2
    CLIUtils/CLI11 6c7b07a878ad834957b98d0f9ce1dbe0cb204fc9)
endif()

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
option(BRUSHFIRE_WITH_EXPAT "Read GIFTI and VTP, which are XML" ON)
if(BRUSHFIRE_WITH_EXPAT)
  find_package(EXPAT)
  if(EXPAT_FOUND)
    string(APPEND BRUSHFIRE_FIND_DEPENDENCIES "find_dependency(EXPAT)\n")
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

# Embree makes ambient occlusion for pictures. It is a shared library that brings TBB along: a machine that has it uses it.
option(BRUSHFIRE_WITH_EMBREE "Ambient occlusion in pictures" ON)
if(BRUSHFIRE_WITH_EMBREE)
  find_package(embree 4 CONFIG QUIET)
  if(NOT embree_FOUND)
    find_package(embree 3 CONFIG QUIET)
  endif()
  if(embree_FOUND)
    string(APPEND BRUSHFIRE_FIND_DEPENDENCIES "find_dependency(embree ${EMBREE_VERSION_MAJOR} CONFIG)\n")
  endif()
endif()

# brushfire_has(TARGET NAME file...): those files of the library know BRUSHFIRE_HAS_NAME. The others do not, so that they
# compile by the same command, and come from the same compiler cache, whatever was found.
function(brushfire_has target name)
  list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/src/brushfire/)
  set_property(SOURCE ${ARGN} TARGET_DIRECTORY ${target} APPEND PROPERTY COMPILE_DEFINITIONS BRUSHFIRE_HAS_${name})
endfunction()

# Links what was found to the library, privately.
function(brushfire_link_dependencies target)
  target_include_directories(${target} SYSTEM PRIVATE ${BRUSHFIRE_FAST_FLOAT_DIR} ${BRUSHFIRE_JSON_DIR} ${BRUSHFIRE_STB_INCLUDE_DIR})
  target_link_libraries(${target} PRIVATE Threads::Threads)
  if(BRUSHFIRE_WITH_ZLIB AND ZLIB_FOUND)
    target_link_libraries(${target} PRIVATE ZLIB::ZLIB)
    brushfire_has(${target} ZLIB io/detail/inflate.cpp figure/image.cpp)
  endif()
  if(BRUSHFIRE_WITH_EXPAT AND EXPAT_FOUND)
    target_link_libraries(${target} PRIVATE EXPAT::EXPAT)
    brushfire_has(${target} EXPAT io/detail/xml.cpp)
  endif()
  if(BRUSHFIRE_WITH_WEBP AND WebP_FOUND)
    target_link_libraries(${target} PRIVATE WebP::libwebpmux)
    brushfire_has(${target} WEBP figure/image.cpp)
  endif()
  if(BRUSHFIRE_WITH_EMBREE AND embree_FOUND)
    target_link_libraries(${target} PRIVATE embree)
    brushfire_has(${target} EMBREE=${EMBREE_VERSION_MAJOR} figure/ambient_occlusion.cpp)
  endif()
endfunction()
