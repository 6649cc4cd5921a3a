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
if(BRUSHFIRE_IO)
  brushfire_find_headers(BRUSHFIRE_FAST_FLOAT_DIR fast_float/fast_float.h  # 6.1.6
    fastfloat/fast_float 00c8c7b0d5c722d2212568d915a39ea73b08b973)
  brushfire_find_headers(BRUSHFIRE_JSON_DIR nlohmann/json.hpp  # 3.11.3
    nlohmann/json 9cca280a4d0ccf0c08f47a99aa71d1b0e52f8d03)
endif()
if(BRUSHFIRE_BUILD_TOOLS)
  brushfire_find_headers(BRUSHFIRE_CLI11_DIR CLI/CLI.hpp  # 2.4.2
    CLIUtils/CLI11 6c7b07a878ad834957b98d0f9ce1dbe0cb204fc9)
endif()

# Sean Barrett's single-file libraries: PNG writing, TrueType.
if(BRUSHFIRE_FIGURE)
  find_path(BRUSHFIRE_STB_INCLUDE_DIR stb_image_write.h PATH_SUFFIXES stb REQUIRED DOC "stb's headers (libstb-dev)")
endif()

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)

# Compiled ones are optional: without them the library says which files it cannot read. Those of a part that is left out
# are not looked for. A static brushfire passes them on to whoever links it, so the installed package looks for the same
# ones: BRUSHFIRE_FIND_DEPENDENCIES for CMake, BRUSHFIRE_PC_MODULES and BRUSHFIRE_PC_LIBRARIES for pkg-config.
option(BRUSHFIRE_WITH_ZLIB "Read and write compressed files" ON)
option(BRUSHFIRE_WITH_EXPAT "Read GIFTI and VTP, which are XML" ON)
option(BRUSHFIRE_WITH_WEBP "Write animations as WebP" ON)
option(BRUSHFIRE_WITH_EMBREE "Ambient occlusion in pictures" ON)
set(BRUSHFIRE_FIND_DEPENDENCIES "")
set(BRUSHFIRE_PC_MODULES "")
set(BRUSHFIRE_PC_LIBRARIES "")
foreach(name ZLIB EXPAT WEBP EMBREE)
  set(BRUSHFIRE_HAS_${name} OFF)
endforeach()

if(BRUSHFIRE_WITH_ZLIB AND (BRUSHFIRE_IO OR BRUSHFIRE_FIGURE))
  find_package(ZLIB)
  if(ZLIB_FOUND)
    set(BRUSHFIRE_HAS_ZLIB ON)
    string(APPEND BRUSHFIRE_FIND_DEPENDENCIES "find_dependency(ZLIB)\n")
    string(APPEND BRUSHFIRE_PC_MODULES " zlib")
  endif()
endif()
if(BRUSHFIRE_WITH_EXPAT AND BRUSHFIRE_IO)
  find_package(EXPAT)
  if(EXPAT_FOUND)
    set(BRUSHFIRE_HAS_EXPAT ON)
    string(APPEND BRUSHFIRE_FIND_DEPENDENCIES "find_dependency(EXPAT)\n")
    string(APPEND BRUSHFIRE_PC_MODULES " expat")
  endif()
endif()
if(BRUSHFIRE_WITH_WEBP AND BRUSHFIRE_FIGURE)
  find_package(WebP)
  if(WebP_FOUND)
    set(BRUSHFIRE_HAS_WEBP ON)
    string(APPEND BRUSHFIRE_FIND_DEPENDENCIES
      "list(APPEND CMAKE_MODULE_PATH \${CMAKE_CURRENT_LIST_DIR})\nfind_dependency(WebP)\n")
    string(APPEND BRUSHFIRE_PC_MODULES " libwebpmux")
  endif()
endif()
# Embree makes ambient occlusion for pictures. It is a shared library that brings TBB along: a machine that has it uses it.
if(BRUSHFIRE_WITH_EMBREE AND BRUSHFIRE_FIGURE)
  find_package(embree 4 CONFIG QUIET)
  if(NOT embree_FOUND)
    find_package(embree 3 CONFIG QUIET)
  endif()
  if(embree_FOUND)
    set(BRUSHFIRE_HAS_EMBREE ON)
    string(APPEND BRUSHFIRE_FIND_DEPENDENCIES "find_dependency(embree ${EMBREE_VERSION_MAJOR} CONFIG)\n")
    string(APPEND BRUSHFIRE_PC_LIBRARIES " -lembree${EMBREE_VERSION_MAJOR}")
  endif()
endif()

# brushfire_has(TARGET NAME file...): those files of the library know BRUSHFIRE_HAS_NAME. The others do not, so that they
# compile by the same command, and come from the same compiler cache, whatever was found.
function(brushfire_has target name)
  list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/src/brushfire/)
  set_property(SOURCE ${ARGN} TARGET_DIRECTORY ${target} APPEND PROPERTY COMPILE_DEFINITIONS BRUSHFIRE_HAS_${name})
endfunction()

# brushfire_link_found(TARGET NAME LIBRARY file...): links LIBRARY privately where BRUSHFIRE_HAS_NAME; those files know it.
function(brushfire_link_found target name library)
  if(BRUSHFIRE_HAS_${name})
    target_link_libraries(${target} PRIVATE ${library})
    brushfire_has(${target} ${name} ${ARGN})
  endif()
endfunction()

# Links what was found to the library, privately.
function(brushfire_link_dependencies target)
  target_link_libraries(${target} PRIVATE Threads::Threads)
  if(BRUSHFIRE_IO)
    target_include_directories(${target} SYSTEM PRIVATE ${BRUSHFIRE_FAST_FLOAT_DIR} ${BRUSHFIRE_JSON_DIR})
    brushfire_link_found(${target} ZLIB ZLIB::ZLIB io/detail/inflate.cpp)
    brushfire_link_found(${target} EXPAT EXPAT::EXPAT io/detail/xml.cpp)
  endif()
  if(BRUSHFIRE_FIGURE)
    target_include_directories(${target} SYSTEM PRIVATE ${BRUSHFIRE_STB_INCLUDE_DIR})
    brushfire_link_found(${target} ZLIB ZLIB::ZLIB figure/image.cpp)
    brushfire_link_found(${target} WEBP WebP::libwebpmux figure/image.cpp)
    if(BRUSHFIRE_HAS_EMBREE)
      target_link_libraries(${target} PRIVATE embree)
      brushfire_has(${target} EMBREE=${EMBREE_VERSION_MAJOR} figure/ambient_occlusion.cpp)
    endif()
  endif()
endfunction()
