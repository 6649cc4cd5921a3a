# cmake -D PROGRAM=... -D MESH=... -D OUTPUT=... -P first_steps.cmake: it does what it says.
file(WRITE ${MESH} "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
file(REMOVE ${OUTPUT})
execute_process(COMMAND ${PROGRAM} ${MESH} ${OUTPUT} OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
if(NOT said STREQUAL "4 of 4 vertices reached\n" OR NOT EXISTS ${OUTPUT})
  message(FATAL_ERROR "the example said: ${said}")
endif()
