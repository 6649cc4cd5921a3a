# cmake -D SOURCE=.../src -P listed.cmake: every header outside of a detail/ folder is either in brushfire.h, which makes it
# public and installs it, or here, which says that it is private and that its folder does not say so yet.
cmake_minimum_required(VERSION 3.22)
set(private
  core/bucket_queue.h core/inline.h core/memory.h core/planar.h core/populate.h core/random.h core/text.h core/uninitialized.h
  mesh/flat_face.h mesh/locality_order.h)

file(READ ${SOURCE}/brushfire/brushfire.h everything)
file(GLOB_RECURSE headers RELATIVE ${SOURCE}/brushfire ${SOURCE}/brushfire/*.h)
foreach(header ${headers})
  string(FIND "${everything}" "#include <brushfire/${header}>" at)
  if(at EQUAL -1 AND NOT header MATCHES "detail/|^solvers/(fast_marching|windows|partition)/|^brushfire.h$" AND NOT header IN_LIST private)
    message(SEND_ERROR "${header} is neither in brushfire.h nor private")
  endif()
  if(NOT at EQUAL -1 AND header IN_LIST private)
    message(SEND_ERROR "${header} is in brushfire.h and private")
  endif()
endforeach()
