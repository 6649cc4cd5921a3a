# cmake -D WAY=find_package|fetch -D SOURCE=... -D BUILD=... -D SCRATCH=... -P consume.cmake
#
# find_package: installs the static library of this build into an empty prefix and builds the consumer against it.
# fetch: builds the consumer with brushfire as a part of it, shared; installs that and builds a second consumer against
# the shared library with find_package.
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
file(WRITE ${SCRATCH}/square.obj "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# build_consumer(NAME option...): configures and builds it, runs it, looks at what it says.
function(build_consumer name)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${CMAKE_CURRENT_LIST_DIR}/project -B ${SCRATCH}/${name}
    -DCMAKE_BUILD_TYPE=Release ${ARGN})
  run(${CMAKE_COMMAND} --build ${SCRATCH}/${name})
  execute_process(COMMAND ${SCRATCH}/${name}/consumer ${SCRATCH}/square.obj ${SCRATCH}/square.ply
    OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  if(NOT said STREQUAL "4 of 4 vertices reached\n" OR NOT EXISTS ${SCRATCH}/square.ply)
    message(FATAL_ERROR "the consumer said: ${said}")
  endif()
endfunction()

if(WAY STREQUAL "find_package")
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
  build_consumer(consumer -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix)
  file(GLOB_RECURSE private ${SCRATCH}/prefix/include/*detail*)
  if(private)
    message(FATAL_ERROR "private headers were installed: ${private}")
  endif()
else()
  build_consumer(fetching -DBRUSHFIRE_SOURCE=${SOURCE} -DBUILD_SHARED_LIBS=ON)
  run(${CMAKE_COMMAND} --install ${SCRATCH}/fetching --prefix ${SCRATCH}/prefix)
  build_consumer(consumer -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix)
endif()
