// Two small meshes for the program, and what it says of them.
#pragma once

#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "in_folder.h"
#include "program.h"

namespace brushfire::test {

// A unit square, and the same with a second component and a lone vertex.
class Program : public InFolder {
 protected:
  void SetUp() override {
    write("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    write("islands.off",
          "OFF\n8 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n9 9 9\n3 0 1 2\n3 0 2 3\n3 4 5 6\n");
  }

  // What the program said, with the test's folder taken out.
  std::string said(const std::string& text) const {
    std::string out = text;
    const std::string folder = path("");
    for (std::size_t at; (at = out.find(folder)) != std::string::npos;) out.erase(at, folder.size());
    return out;
  }

  void expect_error(const std::vector<std::string>& arguments, int code, const std::string& line) const {
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.code, code);
    EXPECT_FALSE(ended.killed);
    EXPECT_EQ(said(ended.err), line + "\n");
    EXPECT_EQ(ended.out, "");
  }
};

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    lines.push_back(text.substr(begin, end - begin));
  }
  return lines;
}

// The keys of the outermost object, in order, of JSON that is indented by two.
inline std::vector<std::string> keys_of(const std::string& json) {
  std::vector<std::string> keys;
  const std::regex key("^  \"([a-z_0-9]+)\":.*");
  for (const std::string& line : lines_of(json)) {
    std::smatch match;
    if (std::regex_match(line, match, key)) keys.push_back(match[1]);
  }
  return keys;
}

}  // namespace brushfire::test
