// Text, line by line.
#include "text_lines.h"

#include <brushfire/core/error.h>

#include <algorithm>
#include <string_view>

namespace brushfire::tool {

bool TextLines::next(std::string& line) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (!read(line)) return false;
  if (number_ > 1) return true;
  if (line.starts_with("\xff\xfe") || line.starts_with("\xfe\xff")) {
    throw Error(ErrorCode::FileMalformed, stream_.name() + ": is text in UTF-16, which is not read: save it as UTF-8");
  }
  if (line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
  return true;
}

bool TextLines::read(std::string& line) {
  constexpr std::size_t kLongest = 65536;
  line.clear();
  ++number_;
  while (true) {
    std::string_view rest(block_.data() + at_, size_ - at_);
    if (after_cr_ && !rest.empty()) {
      after_cr_ = false;
      if (rest.front() == '\n') {
        ++at_;
        continue;
      }
    }
    const std::size_t length = std::min(rest.find_first_of("\r\n"), rest.size());
    if (line.size() + length > kLongest) {
      throw Error(ErrorCode::InvalidArgument, here() + "is longer than " + std::to_string(kLongest) + " bytes");
    }
    line.append(rest, 0, length);
    at_ += length;
    if (length < rest.size()) {
      after_cr_ = rest[length] == '\r';
      ++at_;
      return true;
    }
    at_ = 0;
    size_ = stream_.read(block_.data(), block_.size());
    if (size_ == 0) return !line.empty();
  }
}

}  // namespace brushfire::tool
