// Names of the error codes.
#include <brushfire/core/error.h>

namespace brushfire {

std::string_view name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::InvalidArgument:
      return "invalid_argument";
    case ErrorCode::IndexOutOfRange:
      return "index_out_of_range";
    case ErrorCode::InvalidMesh:
      return "invalid_mesh";
    case ErrorCode::FileNotReadable:
      return "file_not_readable";
    case ErrorCode::FileMalformed:
      return "file_malformed";
    case ErrorCode::FileNotWritable:
      return "file_not_writable";
    case ErrorCode::UnknownFormat:
      return "unknown_format";
    case ErrorCode::Cancelled:
      return "cancelled";
    case ErrorCode::TooLarge:
      return "too_large";
    case ErrorCode::Internal:
      return "internal";
  }
  return "unknown";
}

}  // namespace brushfire
