# A guest's build is one from nothing: what many files include is read once.
#
# The files of each of the library's folders are compiled as one (UNITY_BUILD), and the standard library and our commonest
# headers are precompiled. Files that have options of their own, the inner loops, stay alone, and so do those that have
# a name that another one of the folder has. Where we develop, files are compiled one by one: each names what it uses,
# and a compiler cache knows them. docs/decisions/build-time.md
set(brushfire_from_nothing ON)
if(PROJECT_IS_TOP_LEVEL OR CMAKE_CXX_COMPILER_LAUNCHER OR EMSCRIPTEN)
  set(brushfire_from_nothing OFF)
endif()
option(BRUSHFIRE_TOGETHER "Compile the files of a folder as one, with precompiled headers" ${brushfire_from_nothing})

# brushfire_together(TARGET [APART pattern...]): those that match one of APART stay alone.
function(brushfire_together target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "APART")
  if(NOT BRUSHFIRE_TOGETHER)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Types of an anonymous namespace in others: of interest in headers, which is what these files seem to be. And what
    # GCC concludes after inlining it forgets that it was in the standard library's own code, once that is precompiled.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage
      -Wno-array-bounds -Wno-maybe-uninitialized -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
  target_precompile_headers(${target} PRIVATE <algorithm> <array> <atomic> <bit> <cmath> <cstddef> <cstdint> <cstdio>
    <cstring> <functional> <limits> <map> <memory> <numeric> <optional> <queue> <span> <string> <string_view> <tuple>
    <type_traits> <unordered_map> <utility> <vector> <brushfire/core/cancel.h> <brushfire/core/error.h>
    <brushfire/mesh/mesh.h> <brushfire/mesh/surface_point.h>)
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
