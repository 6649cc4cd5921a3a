// The verb view: what it puts into the page. That the page shows it is tested in a browser (web/test).
#include "in_folder.h"
#include "program.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace brushfire::test {
namespace {

class View : public InFolder {
 protected:
  void SetUp() override {
    write("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    write("empty.html", "<html>\n<!-- brushfire view: the mesh -->\n</html>\n");
    use("empty.html");
  }
  void TearDown() override { unsetenv("BRUSHFIRE_VIEWER"); }
  void use(const std::string& page) const { setenv("BRUSHFIRE_VIEWER", path(page).c_str(), 1); }
};

TEST_F(View, ThePageHoldsTheMeshAndWhereItStarts) {
  const Ended ended =
      run_program({"view", path("square.off"), "--source", "2", "--method", "exact", "-o", path("a.html")});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::string page = content("a.html");
  EXPECT_NE(page.find("\"name\": \"square.off\""), std::string::npos) << page;
  EXPECT_NE(page.find("\"method\": \"exact\""), std::string::npos) << page;
  EXPECT_NE(page.find("\"sources\": [{\"face\": 0, \"weights\": [0, 0, 1]}]"), std::string::npos) << page;
  EXPECT_NE(page.find(">cGx5"), std::string::npos) << "base64 of 'ply'";
  EXPECT_EQ(page.find("brushfire view: the mesh"), std::string::npos);
}

TEST_F(View, ANameCannotEndTheScriptThatItStandsIn) {
  write("<script>.off", content("square.off"));
  const Ended ended = run_program({"view", path("<script>.off"), "-o", path("a.html")});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(content("a.html").find("\"\\u003cscript>.off\""), std::string::npos);
}

TEST_F(View, SaysWhatIsMissing) {
  use("nowhere.html");
  Ended ended = run_program({"view", path("square.off")});
  EXPECT_EQ(ended.code, 3);
  EXPECT_NE(ended.err.find("the viewer's page is not installed"), std::string::npos) << ended.err;
  use("square.off");
  ended = run_program({"view", path("square.off")});
  EXPECT_EQ(ended.code, 3);
  EXPECT_NE(ended.err.find("is not the viewer's page"), std::string::npos) << ended.err;
  use("empty.html");
  write("points.off", "OFF\n1 0 0\n0 0 0\n");
  ended = run_program({"view", path("points.off"), "-o", path("a.html")});
  EXPECT_NE(ended.code, 0);
  EXPECT_NE(ended.err.find("has no faces to show"), std::string::npos) << ended.err;
}

TEST_F(View, WithoutAScreenItSaysWhereThePageIs) {
  const std::string screen = std::getenv("DISPLAY") != nullptr ? std::getenv("DISPLAY") : "";
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  setenv("TMPDIR", path(".").c_str(), 1);
  const Ended ended = run_program({"view", path("square.off")});
  unsetenv("TMPDIR");
  if (!screen.empty()) setenv("DISPLAY", screen.c_str(), 1);
#ifdef __APPLE__
  GTEST_SKIP() << "macOS has a screen whatever the environment says";
#endif
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("no browser could be started here; the page is "), std::string::npos) << ended.out;
  EXPECT_NE(content("brushfire-square-1.html").find("held-mesh"), std::string::npos);
}

}  // namespace
}  // namespace brushfire::test
