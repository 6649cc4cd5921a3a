// Curves to files: what each format holds, and refusals.
#include <brushfire/core/error.h>
#include <brushfire/io/write_lines.h>
#include <brushfire/mesh/shapes.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace brushfire {
namespace {

class WriteLines : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() /
                 ("brushfire-lines-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string write(const std::string& extension, const std::vector<SurfacePath>& lines) const {
    const std::string path = (directory_ / ("lines." + extension)).string();
    write_lines(path, mesh_, lines, "length");
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }

  std::filesystem::path directory_;
  Mesh mesh_ = shapes::plane(1, 1).mesh();
  // Along the diagonal, and around face 0.
  std::vector<SurfacePath> open_{{{{0, {1, 0, 0}}, {0, {0.5, 0, 0.5}}}, 0.75, false}};
  std::vector<SurfacePath> both_{open_[0], {{{0, {1, 0, 0}}, {0, {0, 1, 0}}, {0, {0, 0, 1}}}, 3.5, true}};
};

TEST_F(WriteLines, JsonOfOneLineHasItsPointsAtTheTop) {
  const std::string text = write("json", open_);
  EXPECT_EQ(text,
            "{\"schema\": 1,\n"
            " \"length\": 0.75, \"closed\": false,\n"
            " \"points\": [\n"
            "  {\"face\": 0, \"weights\": [1,0,0], \"position\": [0,0,0]},\n"
            "  {\"face\": 0, \"weights\": [0.5,0,0.5], \"position\": [0.5,0.5,0]}]}\n");
}

TEST_F(WriteLines, JsonOfSeveralLinesIsAList) {
  const std::string text = write("json", both_);
  EXPECT_NE(text.find("\"lines\": ["), std::string::npos);
  EXPECT_NE(text.find("\"length\": 3.5, \"closed\": true"), std::string::npos);
}

TEST_F(WriteLines, ObjClosesAClosedCurveWithItsFirstVertex) {
  const std::string text = write("obj", both_);
  EXPECT_NE(text.find("l 1 2\n"), std::string::npos);
  EXPECT_NE(text.find("l 3 4 5 3\n"), std::string::npos);
}

TEST_F(WriteLines, PlyHasOneEdgePerPiece) {
  const std::string text = write("ply", both_);
  EXPECT_NE(text.find("element vertex 5\n"), std::string::npos);
  EXPECT_NE(text.find("element edge 4\n"), std::string::npos);
  EXPECT_NE(text.find("\n4 2\n"), std::string::npos);  // back to the closed curve's first point
}

TEST_F(WriteLines, VtpCountsItsPointsAndLines) {
  const std::string text = write("vtp", both_);
  EXPECT_NE(text.find("NumberOfPoints=\"5\""), std::string::npos);
  EXPECT_NE(text.find("NumberOfLines=\"2\""), std::string::npos);
  EXPECT_NE(text.find("<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n2\n6\n"), std::string::npos);
}

TEST_F(WriteLines, CsvHasOneRowPerPoint) {
  const std::string text = write("csv", open_);
  EXPECT_EQ(text,
            "line,length,point,x,y,z,face,w0,w1,w2,closed\n"
            "0,0.75,0,0,0,0,0,1,0,0,0\n"
            "0,0.75,1,0.5,0.5,0,0,0.5,0,0.5,0\n");
}

TEST_F(WriteLines, SvgOfAFlatMeshIsSeenFromAbove) {
  const std::string text = write("svg", both_);
  EXPECT_NE(text.find("d=\"M0 0L0.5 -0.5\""), std::string::npos) << text;
  EXPECT_NE(text.find("Z\"/>"), std::string::npos);
}

TEST_F(WriteLines, NoLinesAreAValidFileInEveryFormat) {
  for (const char* extension : {"json", "obj", "ply", "vtp", "csv", "svg", "dxf"})
    EXPECT_NO_THROW(write(extension, {}));
}

TEST_F(WriteLines, ValuesOfTheCallerStandInPlaceOfLengths) {
  const std::vector<double> levels{0.5, 8};
  const std::vector<std::uint8_t> bytes = encode_lines(mesh_, both_, "level", "csv", {.values = levels});
  const std::string text(bytes.begin(), bytes.end());
  EXPECT_NE(text.find("\n0,0.5,0,"), std::string::npos) << text;
  EXPECT_NE(text.find("\n1,8,0,"), std::string::npos) << text;
  EXPECT_THROW(encode_lines(mesh_, open_, "level", "csv", {.values = levels}), Error) << "two values for one curve";
}

TEST_F(WriteLines, UnknownExtensionIsAnErrorThatListsTheFormats) {
  try {
    write("xyz", open_);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::UnknownFormat);
    EXPECT_NE(std::string(e.what()).find("json, obj, ply, vtp, csv, svg or dxf"), std::string::npos);
  }
}

}  // namespace
}  // namespace brushfire
