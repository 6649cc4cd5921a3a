// The one exception type of the library: a code for programs, a sentence for people.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace brushfire {

enum class ErrorCode {
  InvalidArgument,  // a value that the call does not take: an empty source list, a negative tolerance
  IndexOutOfRange,  // a vertex, face or source number that does not exist
  InvalidMesh,      // a mesh that cannot be built: an index beyond the vertices, a coordinate that is not finite
  FileNotReadable,  // no such file, no permission, a directory
  FileMalformed,    // the file is not what its format says it is
  FileNotWritable,  // the output could not be written
  UnknownFormat,    // neither the name nor the content of the file names a format that is known
  Cancelled,        // the caller's CancelToken was set
  TooLarge,         // the result would not fit into memory or into 32-bit indices
  Internal,         // a fault of this library, found by itself: please report it
};

// A short stable name of the code, as it appears in `--json` and in Python: "invalid_argument", ...
std::string_view name_of(ErrorCode code);

// Thrown by everything in the library that fails, std::bad_alloc aside. what() is one line that says what was wrong,
// where (file, line, index, value) and, where it helps, what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace brushfire
