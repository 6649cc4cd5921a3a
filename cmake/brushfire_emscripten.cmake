# What a build for WebAssembly needs and emscripten's own folders lack. Headers are the machine's: a folder of links, as
# the machine's include folder as a whole would bring its C library along. zlib and expat are compiled here.
include(FetchContent)
enable_language(C)

set(brushfire_links ${CMAKE_BINARY_DIR}/links)
file(MAKE_DIRECTORY ${brushfire_links})
foreach(folder boost fast_float nlohmann)
  find_path(BRUSHFIRE_${folder}_PARENT ${folder} NO_CMAKE_FIND_ROOT_PATH PATHS /usr/include /usr/local/include REQUIRED)
  file(CREATE_LINK ${BRUSHFIRE_${folder}_PARENT}/${folder} ${brushfire_links}/${folder} SYMBOLIC)
endforeach()
set(Boost_INCLUDE_DIRS ${brushfire_links})
set(BRUSHFIRE_FAST_FLOAT_DIR ${brushfire_links} CACHE PATH "Where fast_float/fast_float.h is")
set(BRUSHFIRE_JSON_DIR ${brushfire_links} CACHE PATH "Where nlohmann/json.hpp is")

# brushfire_fetch_c(NAME URL SHA256 FOLDER FILES...): a static library of these files in FOLDER, whose headers lie there.
function(brushfire_fetch_c name url sha256 folder)
  # Its own CMakeLists.txt is left alone: it would install things.
  FetchContent_Declare(${name} URL ${url} URL_HASH SHA256=${sha256} DOWNLOAD_EXTRACT_TIMESTAMP ON SOURCE_SUBDIR none)
  FetchContent_MakeAvailable(${name})
  list(TRANSFORM ARGN PREPEND ${${name}_SOURCE_DIR}/${folder})
  add_library(brushfire_${name} STATIC ${ARGN})
  target_include_directories(brushfire_${name} SYSTEM PUBLIC ${${name}_SOURCE_DIR}/${folder})
  target_compile_options(brushfire_${name} PRIVATE -w)
endfunction()

if(BRUSHFIRE_IO)
  set(pool https://deb.debian.org/debian/pool/main)
  brushfire_fetch_c(zlib ${pool}/z/zlib/zlib_1.3.dfsg%2breally1.3.1.orig.tar.gz
    60dd315c07f616887caa029408308a018ace66e3d142726a97db164b3b8f69fb ""
    adler32.c compress.c crc32.c deflate.c inffast.c inflate.c inftrees.c trees.c zutil.c)
  brushfire_fetch_c(expat ${pool}/e/expat/expat_2.7.1.orig.tar.gz
    85372797ff0673a8fc4a6be16466bb5a0ca28c0dcf3c6f7ac1686b4a3ba2aabb expat/lib/ xmlparse.c xmlrole.c xmltok.c)
  # What its configure script would write, as Debian has it; random numbers are those of the surroundings.
  file(WRITE ${CMAKE_BINARY_DIR}/expat_config/expat_config.h "#define BYTEORDER 1234\n#define XML_CONTEXT_BYTES 1024\n"
    "#define XML_DTD 1\n#define XML_GE 1\n#define XML_NS 1\n#define HAVE_ARC4RANDOM_BUF 1\n#include <stddef.h>\n"
    "__attribute__((import_module(\"wasi_snapshot_preview1\"), import_name(\"random_get\")))\n"
    "int brushfire_random(void*, size_t);\n#define arc4random_buf(bytes, size) brushfire_random(bytes, size)\n")
  target_include_directories(brushfire_expat PRIVATE ${CMAKE_BINARY_DIR}/expat_config)
  add_library(ZLIB::ZLIB ALIAS brushfire_zlib)
  add_library(EXPAT::EXPAT ALIAS brushfire_expat)
endif()

# brushfire_small(TARGET OPTION PATTERN...): these files of the library, whose speed nobody waits for, are compiled to be
# small: a page fetches them before it can begin. docs/decisions/web.md has what that costs and brings.
function(brushfire_small target option)
  get_target_property(files ${target} SOURCES)
  list(JOIN ARGN "|" patterns)
  foreach(file ${files})
    if(file MATCHES "src/brushfire/(${patterns})")
      set_property(SOURCE ${file} TARGET_DIRECTORY ${target} APPEND PROPERTY COMPILE_OPTIONS ${option})
    endif()
  endforeach()
endfunction()
