# Builds from nothing take half the time where files are compiled together: what they include is read once, and what they
# use of templates compiled once.
#
# BRUSHFIRE_TOGETHER does that for the tests, and for the library of builds with sanitizers, as files of a dozen files
# (UNITY_BUILD), and reads the standard library once for all other files of the library and the program (precompiled
# headers; our own are left out of those, so that a change to one costs what it did and warnings in them are seen). The
# library that is used is compiled file by file: what a compiler makes of one does not depend on its neighbours.
#
# Files still name all that they use, and names within two of a room that are the same are no error. Builds without this
# hold the first: those with a compiler cache, which is of more use file by file, WebAssembly, ./run lint and ./run compilers.
set(brushfire_from_nothing ON)
if(CMAKE_CXX_COMPILER_LAUNCHER OR EMSCRIPTEN)
  set(brushfire_from_nothing OFF)
endif()
option(BRUSHFIRE_TOGETHER "Compile what can be together: a build from nothing takes half the time" ${brushfire_from_nothing})

# brushfire_together(TARGET [APART pattern...]): the files of each of its folders are compiled as one, but for those APART,
# in which something has the name that it has in another.
function(brushfire_together target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "APART")
  if(NOT BRUSHFIRE_TOGETHER)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Types of an anonymous namespace in others: of interest in headers, which is what these files seem to be.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
  get_target_property(files ${target} SOURCES)
  list(JOIN arg_APART "|" apart)
  foreach(file ${files})
    get_filename_component(folder ${file} DIRECTORY)
    if(NOT apart OR NOT file MATCHES "(${apart})$")
      string(MAKE_C_IDENTIFIER "${folder}" group)
      set_property(SOURCE ${file} TARGET_DIRECTORY ${target} PROPERTY UNITY_GROUP "${group}")
    endif()
  endforeach()
endfunction()

# brushfire_precompile(TARGET header...): reads what most files of the target include, and these, once.
function(brushfire_precompile target)
  if(NOT BRUSHFIRE_TOGETHER)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE <algorithm> <array> <atomic> <bit> <cmath> <cstddef> <cstdint> <cstdio>
    <cstring> <functional> <limits> <map> <memory> <numeric> <optional> <queue> <span> <string> <string_view> <tuple>
    <type_traits> <unordered_map> <utility> <vector> ${ARGN})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Of what GCC concludes after inlining it forgets that it was in the standard library's own code: false alarms.
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-maybe-uninitialized -Wno-stringop-overflow
      -Wno-stringop-overread)
  endif()
endfunction()
