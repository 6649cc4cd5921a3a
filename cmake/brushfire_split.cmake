# cmake -D whole=A.wasm -D first=B.wasm -D second=C.wasm -P brushfire_split.cmake: takes the windows of wide numbers, a fifth
# of the code, which few meshes need, out of a module and into a second one. The first calls imports of the name
# "placeholder" in their place; once lib/module.js has made an instance of the second, they are in its table.
find_program(wasm_split wasm-split REQUIRED)
find_program(wasm_opt wasm-opt REQUIRED)
set(features --enable-simd --enable-exception-handling --enable-bulk-memory --enable-sign-ext --enable-mutable-globals
  --enable-nontrapping-float-to-int)

execute_process(COMMAND ${wasm_opt} ${features} ${whole} --print-function-map OUTPUT_VARIABLE map ERROR_QUIET
  COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^:\n]*in_double_doubles[^\n]*" wide "${map}")
list(LENGTH wide count)
if(count EQUAL 0)
  message(FATAL_ERROR "no function of ${whole} is of wide numbers")
endif()
list(JOIN wide "\n" wide)
file(WRITE ${whole}.wide.txt "${wide}\n")
execute_process(COMMAND ${wasm_split} ${features} ${whole} --split-funcs=@${whole}.wide.txt --export-prefix=%
  -o1 ${first} -o2 ${second} COMMAND_ERROR_IS_FATAL ANY)
foreach(module ${first} ${second})
  execute_process(COMMAND ${wasm_opt} ${features} --strip-debug --post-emscripten -Oz --low-memory-unused --zero-filled-memory
    ${module} -o ${module} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
