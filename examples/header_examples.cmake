# cmake -D HEADERS=a.h;b.h -D FOLDER=.../src -D README=... -D OUTPUT=header_examples.cpp -P header_examples.cmake
# The examples in the comments that public headers begin with, and the README's, as one program: a function each, called
# in turn.
file(READ "${README}" text)
if(NOT text MATCHES "```c\\+\\+\n([^`]+)```")
  message(FATAL_ERROR "${README} has no block of C++")
endif()
set(functions "void readme() {\n${CMAKE_MATCH_1}  std::printf(\"%zu distances\\n\", d.size());\n}\n\n")
set(calls "  readme();\n")
foreach(header ${HEADERS})
  file(READ "${FOLDER}/${header}" text)
  if(NOT text MATCHES "// Example:\n((//     [^\n]*\n)+)")
    message(FATAL_ERROR "${header} has no block that begins with '// Example:'")
  endif()
  string(REGEX REPLACE "(^|\n)//" "\\1" body "${CMAKE_MATCH_1}")
  string(MAKE_C_IDENTIFIER "${header}" name)
  string(APPEND functions "void ${name}() {\n${body}}\n\n")
  string(APPEND calls "  ${name}();\n")
endforeach()
file(WRITE "${OUTPUT}" "// Generated from the headers by examples/header_examples.cmake.
#include <brushfire/brushfire.h>

#include <cstdio>
#include <optional>
#include <vector>

namespace {

${functions}}  // namespace

int main() {
${calls}}
")
