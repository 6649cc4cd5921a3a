# cmake -D README=... -D SOURCE=... -D PROGRAM=... -D MESH=... -D OUTPUT=... -P readme_example.cmake
# The README's C++ block is examples/first_steps.cpp, letter by letter, and that does what the README says of it.
file(READ ${README} readme)
file(READ ${SOURCE} source)
string(FIND "${readme}" "```cpp\n${source}```\n" at)
if(at EQUAL -1)
  message(FATAL_ERROR "${README} has no block of C++ that equals ${SOURCE}: copy it there")
endif()

file(WRITE ${MESH} "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
file(REMOVE ${OUTPUT})
execute_process(COMMAND ${PROGRAM} ${MESH} ${OUTPUT} OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
if(NOT said STREQUAL "4 of 4 vertices reached\n" OR NOT EXISTS ${OUTPUT})
  message(FATAL_ERROR "the example said: ${said}")
endif()
