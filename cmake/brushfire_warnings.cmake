# The warnings that every target of this project compiles under. With BRUSHFIRE_WERROR they are errors, but for those that
# an update of somebody else's header or of the compiler brings: a new machine is no reason to fail.
if(BRUSHFIRE_WERROR AND MSVC)
  set(brushfire_werror /WX)
elseif(BRUSHFIRE_WERROR AND (
    (CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 15) OR
    (CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 20)))
  set(brushfire_werror -Werror -Wno-error=deprecated-declarations)
else()
  set(brushfire_werror "")
endif()

function(brushfire_warnings target)
  if(MSVC)
    target_compile_options(${target} PRIVATE /W4 ${brushfire_werror})
  else()
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast
      -Wcast-qual -Wconversion -Wno-sign-conversion -Wextra-semi ${brushfire_werror})
    # What GCC concludes after inlining is of no use where it concludes it of the standard library's own code: false alarms.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
      target_compile_options(${target} PRIVATE -Wno-restrict)  # on string + string (GCC bug 105651)
    elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE  # on vector::insert, on a variant that is moved
        -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
    else()
      target_compile_options(${target} PRIVATE -Wno-bitwise-instead-of-logical  # two comparisons without a branch: meant
        -Wno-bitwise-conditional-parentheses
        -Wno-deprecated-declarations)  # within std::stable_sort of libstdc++ 12; what we call ourselves, GCC tells
    endif()
  endif()
endfunction()
