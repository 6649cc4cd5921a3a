# cmake -D SOURCE=... -P files.cmake: no source file has more than 400 lines, apart from those that are named here, each
# with the reason why it is better whole; and every C++ file begins with a line that says what it does.
cmake_minimum_required(VERSION 3.22)
set(most 400)
set(whole
  run                                       # the front door of a fresh machine: it needs nothing beside itself
  js/lib/index.d.ts                         # the types of the package, which its users read as one page
  src/brushfire/figure/font/font_data.cpp   # a table
  tests/oracle/polyhedral.cpp)              # an argument of four rules that a reader checks in one go, beside no other code

set(files run .ci/run)
foreach(folder benchmarks cmake examples fuzz js programs python src tests tools web)
  foreach(ending h cpp py js mjs ts cmake sh css)
    file(GLOB_RECURSE found RELATIVE ${SOURCE} ${SOURCE}/${folder}/*.${ending})
    list(APPEND files ${found})
  endforeach()
endforeach()
list(FILTER files EXCLUDE REGEX "(^|/)(node_modules|build|dist|__pycache__|\\.[a-z_]+|[a-z_]*venv)/")

set(looked_at 0)
foreach(file ${files})
  file(READ ${SOURCE}/${file} text)
  string(REGEX REPLACE "[^\n]" "" ends "${text}")
  string(LENGTH "${ends}" lines)
  math(EXPR looked_at "${looked_at} + 1")
  if(file MATCHES "\\.(h|cpp)$" AND NOT text MATCHES "^// ")
    message(SEND_ERROR "${file}: its first line does not say what it does")
  endif()
  if(lines GREATER most AND NOT file IN_LIST whole)
    message(SEND_ERROR "${file}: ${lines} lines; ${most} is the most: which of its ideas could have a file of its own?")
  elseif(NOT lines GREATER most AND file IN_LIST whole)
    message(SEND_ERROR "${file}: ${lines} lines, and still named as longer than ${most} in tests/tree/files.cmake")
  endif()
endforeach()
foreach(file ${whole})
  if(NOT file IN_LIST files)
    message(SEND_ERROR "${file}: named in tests/tree/files.cmake, and not there")
  endif()
endforeach()
if(looked_at LESS 600)
  message(FATAL_ERROR "only ${looked_at} files were looked at")
endif()
