// Lists and tables that options name: whoever wrote them, on whatever system, they say the same.
#include "in_folder.h"
#include "program.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace brushfire::test {
namespace {

class TextOfOptions : public InFolder {
 protected:
  // An option of `distance`, and the lines of its file; 8 faces, 9 vertices.
  struct Case {
    const char* option;
    std::vector<std::string> lines;
  };
  const std::vector<Case> cases{{"--sources", {"0", "5@0.5 # with a value"}},
                                {"--block-edges", {"1 4", "4 7"}},
                                {"--block-faces", {"0", "5"}},
                                {"--mask", {"1", "1", "1", "1", "1", "1", "0", "1", "1"}},
                                {"--weights", {"1", "2", "3", "4", "5", "6", "7", "8"}},
                                {"--edge-weights", {"0 1 0.5", "1,4,2,0.25"}},
                                {"--grain", std::vector<std::string>(8, "1 0 0 2.5")},
                                {"--slope", {"-1 2", "0 1", "1 3"}}};

  void SetUp() override { write_squares("squares.off", 2, 2); }

  Ended run(const Case& c, const std::string& content) const {
    write("list.txt", content);
    std::vector<std::string> words{"distance", path("squares.off"), c.option, path("list.txt"), "--target", "8"};
    if (c.option != std::string("--sources")) words.insert(words.end(), {"--source", "2"});
    return run_program(words);
  }

  static std::string joined(const Case& c, const std::string& end, const std::string& blank = " ") {
    std::string content;
    for (const std::string& line : c.lines) {
      for (const char letter : line) content += letter == ' ' ? blank : std::string(1, letter);
      content += end;
    }
    return content;
  }
};

TEST_F(TextOfOptions, MarksLineEndsAndTabsChangeNothing) {
  for (const Case& c : cases) {
    const Ended plain = run(c, joined(c, "\n"));
    ASSERT_EQ(plain.code, 0) << c.option << ": " << plain.err;
    for (const std::string& content : {"\xef\xbb\xbf" + joined(c, "\n"), joined(c, "\r\n"), joined(c, "\r"),
                                       joined(c, "\n\n"), joined(c, "\n", "\t"), joined(c, " \n", "  ")}) {
      const Ended ended = run(c, content);
      EXPECT_EQ(ended.code, 0) << c.option << ": " << ended.err;
      EXPECT_EQ(ended.out, plain.out) << c.option;
    }
  }
}

TEST_F(TextOfOptions, Utf16IsRefusedByNameAndRawBytesAreNotPrinted) {
  for (const Case& c : cases) {
    std::string wide = "\xff\xfe";
    for (const char letter : joined(c, "\n")) wide += {letter, '\0'};
    const Ended refused = run(c, wide);
    EXPECT_EQ(refused.code, 3) << c.option;
    EXPECT_NE(refused.err.find("list.txt: is text in UTF-16, which is not read: save it as UTF-8"), std::string::npos)
        << c.option << ": " << refused.err;
    const Ended raw = run(c, "\x1b[31m\x01\xaa\n");
    EXPECT_NE(raw.code, 0) << c.option;
    EXPECT_NE(raw.err.find("list.txt:1: '\\x1b[31m\\x01\\xaa'"), std::string::npos) << c.option << ": " << raw.err;
  }
}

}  // namespace
}  // namespace brushfire::test
