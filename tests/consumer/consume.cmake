# cmake -D WAY=find_package|fetch|core -D SOURCE=... -D BUILD=... -D SCRATCH=... -P consume.cmake
#
# find_package: installs the static library of this build into an empty prefix, builds the consumer against it, by CMake
# and by pkg-config, and compiles each installed header alone and all of them together.
# fetch: builds the consumer with brushfire as a part of it, shared; installs that and builds a second consumer against
# the shared library with find_package.
# core: builds a consumer of the solvers alone, with brushfire as a part of it that neither reads files nor draws, and
# tells what that costs.
cmake_minimum_required(VERSION 3.22)
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
file(WRITE ${SCRATCH}/square.obj "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(configure name)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${CMAKE_CURRENT_LIST_DIR}/project -B ${SCRATCH}/${name}
    -DCMAKE_BUILD_TYPE=Release ${ARGN})
endfunction()

function(configure_and_build name)
  configure(${name} ${ARGN})
  run(${CMAKE_COMMAND} --build ${SCRATCH}/${name})
endfunction()

# build_telling_time(NAME): builds what is configured, and says what it took, of all processors together.
function(build_telling_time name)
  find_program(shell sh)
  if(NOT shell)
    run(${CMAKE_COMMAND} --build ${SCRATCH}/${name})
    return()
  endif()
  # `times`: of the shell itself on one line, of what it ran on the next; user and system.
  execute_process(COMMAND ${shell} -c "\"$@\" >&2 && times" sh ${CMAKE_COMMAND} --build ${SCRATCH}/${name}
    OUTPUT_VARIABLE times COMMAND_ERROR_IS_FATAL ANY)
  if(NOT times MATCHES "\n([0-9]+)m([0-9]+)[.0-9]*s")
    message(FATAL_ERROR "no times: ${times}")
  endif()
  math(EXPR seconds "60 * ${CMAKE_MATCH_1} + ${CMAKE_MATCH_2}")
  message(STATUS "${name}: compiled in ${seconds} s of processor time")
endfunction()

# run_consumer(program): runs it and looks at what it says.
function(run_consumer program)
  file(REMOVE ${SCRATCH}/square.ply)
  execute_process(COMMAND ${program} ${SCRATCH}/square.obj ${SCRATCH}/square.ply
    OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  if(NOT said STREQUAL "4 of 4 vertices reached\n" OR NOT EXISTS ${SCRATCH}/square.ply)
    message(FATAL_ERROR "the consumer said: ${said}")
  endif()
endfunction()

# build_consumer(NAME option...): configures and builds it, runs it.
function(build_consumer name)
  configure_and_build(${name} ${ARGN})
  run_consumer(${SCRATCH}/${name}/consumer)
endfunction()

# Exactly what is public is installed: no header of a detail/ folder, none that brushfire.h does not name.
function(check_headers prefix)
  file(GLOB_RECURSE headers RELATIVE ${prefix}/include ${prefix}/include/*.h)
  file(READ ${prefix}/include/brushfire/brushfire.h everything)
  foreach(header ${headers})
    string(FIND "${everything}" "#include <${header}>" at)
    if(header MATCHES "/detail/" OR (at EQUAL -1 AND NOT header STREQUAL "brushfire/brushfire.h"))
      message(FATAL_ERROR "a private header was installed: ${header}")
    endif()
  endforeach()
  list(LENGTH headers count)
  if(count LESS 30)
    message(FATAL_ERROR "only ${count} headers were installed")
  endif()
endfunction()

# What a Makefile would do, where there is pkg-config.
function(build_by_pkg_config prefix)
  find_program(pkg_config pkg-config)
  if(NOT pkg_config OR NOT COMPILER)
    message(STATUS "no pkg-config here: the pkg-config file is not tried")
    return()
  endif()
  file(GLOB_RECURSE file ${prefix}/*/brushfire.pc)
  get_filename_component(folder ${file} DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} ${folder})
  execute_process(COMMAND ${pkg_config} --cflags --libs brushfire
    OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${COMPILER} -std=c++20 ${CMAKE_CURRENT_LIST_DIR}/../../examples/first_steps.cpp -o ${SCRATCH}/by_pkg_config ${flags})
  run_consumer(${SCRATCH}/by_pkg_config)
endfunction()

# The program of this build brings its manual pages and completions along.
function(check_program prefix)
  if(EXISTS ${prefix}/bin/brushfire)
    foreach(file man/man1/brushfire.1 man/man1/brushfire-distance.1 bash-completion/completions/brushfire
        zsh/site-functions/_brushfire fish/vendor_completions.d/brushfire.fish licenses/brushfire/LICENSE)
      if(NOT EXISTS ${prefix}/share/${file})
        message(FATAL_ERROR "not installed: share/${file}")
      endif()
    endforeach()
  endif()
endfunction()

if(WAY STREQUAL "find_package")
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
  check_headers(${SCRATCH}/prefix)
  check_program(${SCRATCH}/prefix)
  build_consumer(consumer -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix -DEACH_HEADER=${SCRATCH}/prefix/include)
  build_by_pkg_config(${SCRATCH}/prefix)
elseif(WAY STREQUAL "core")
  # As it is for somebody who does that for the first time: no compiler cache.
  set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} "")
  configure(core -DBRUSHFIRE_SOURCE=${SOURCE} -DBRUSHFIRE_HEAT=OFF
    -DBRUSHFIRE_QUERIES=OFF -DBRUSHFIRE_IO=OFF -DBRUSHFIRE_FIGURE=OFF)
  build_telling_time(core)
  run(${SCRATCH}/core/core_consumer)
else()
  build_consumer(fetching -DBRUSHFIRE_SOURCE=${SOURCE} -DBUILD_SHARED_LIBS=ON)
  run(${CMAKE_COMMAND} --install ${SCRATCH}/fetching --prefix ${SCRATCH}/prefix)
  build_consumer(consumer -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix)
endif()
