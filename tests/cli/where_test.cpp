// Places as text: every form, and every way to get one wrong.
#include "where.h"

#include <brushfire/core/error.h>

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <vector>

namespace brushfire::tool {
namespace {

Mesh square() {
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Face> faces{{0, 1, 2}, {0, 2, 3}};
  return Mesh(positions, faces);
}

SurfacePoint no_snap(Vec3) { throw std::logic_error("nothing to snap here"); }

std::string refusal(std::string_view text) {
  try {
    parse_where(text);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::InvalidArgument);
    return e.what();
  }
  ADD_FAILURE() << "'" << text << "' was taken";
  return {};
}

TEST(Where, ANumberIsAVertex) {
  const Where where = parse_where(" 17 ");
  EXPECT_EQ(std::get<VertexPlace>(where.place).index, 17u);
  EXPECT_EQ(where.offset, 0);
  EXPECT_FALSE(where.has_offset);
  EXPECT_EQ(where.text, "17");
}

TEST(Where, FaceAndWeights) {
  const auto place = std::get<FacePlace>(parse_where("f:120:.2,.3,.5").place);
  EXPECT_EQ(place.face, 120u);
  EXPECT_EQ(place.weights, (std::array<double, 3>{.2, .3, .5}));
}

TEST(Where, ThreeNumbersAfterAtAreAPosition) {
  EXPECT_EQ(std::get<Vec3>(parse_where("at:1.5, -2e-3,+4").place), (Vec3{1.5, -2e-3, 4}));
  EXPECT_EQ(std::get<Vec3>(parse_where("at:1,2,3").place), (Vec3{1, 2, 3}));
}

TEST(Where, ThreeNumbersAloneAreThreeVerticesAndNeverAPosition) {
  EXPECT_EQ(split_places({"1,2,3", "7", " 4 , 5@0.5"}), (std::vector<std::string>{"1", "2", "3", "7", "4 ", " 5@0.5"}));
  EXPECT_EQ(split_places({"f:1:.5,.5,0", "at:1,2,3"}), (std::vector<std::string>{"f:1:.5,.5,0", "at:1,2,3"}));
  EXPECT_EQ(split_places({"", "1,"}), (std::vector<std::string>{"", "1", ""}));
  for (const char* text : {"1.5,0,-2", "1,2,-3", "1,2,3.0"}) {
    const std::vector<std::string> places = split_places({text});
    ASSERT_EQ(places.size(), 1u) << text;
    EXPECT_NE(refusal(places[0]).find("a position begins with at:"), std::string::npos) << text;
  }
}

TEST(Where, WhatFollowsTheAtSignIsTheOffset) {
  for (const char* text : {"17@-0.5", "f:0:1,0,0@-0.5", "at:0,0,0 @ -0.5"}) {
    const Where where = parse_where(text);
    EXPECT_TRUE(where.has_offset) << text;
    EXPECT_EQ(where.offset, -0.5) << text;
  }
}

TEST(Where, AnythingElseIsRefusedWithItsTextAndTheReason) {
  for (const char* text : {"",        " ",      "@1",  "-1",    "1.5",        "seven",   "17@",         "17@x",
                           "17@inf",  "17@1@2", "1,2", "1,2,3", "at:1,2",     "at:",     "at:1,2,3,4",  "at:1,2,nan",
                           "at:1,,3", "f:",     "f:1", "f:1:",  "f:-1:1,0,0", "f:1:1,0", "f:1:1,0,0,0", "0x10"}) {
    const std::string message = refusal(text);
    EXPECT_NE(message.find("write a vertex (17)"), std::string::npos) << message;
  }
  EXPECT_EQ(
      refusal("1,2,3"),
      "'1,2,3' is no place on a mesh: one place is needed here, and several numbers are several vertices; write a "
      "vertex (17), a face and weights (f:120:.2,.3,.5) or a position (at:1.5,0,-2)");
}

TEST(Where, AVertexThatTheMeshHasNotIsOutOfRangeHoweverLarge) {
  for (const char* text : {"4", "4294967295", "4294967296", "99999999999999999999999999"}) {
    try {
      resolve(parse_where(text), square(), no_snap);
      FAIL() << text;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::IndexOutOfRange);
      EXPECT_EQ(std::string(e.what()), "'" + std::string(text) + "': there is no such vertex, the mesh has 4");
    }
  }
}

TEST(Where, ResolvesToTheVertexTheFaceAndTheSnappedPosition) {
  const Mesh mesh = square();
  EXPECT_EQ(position(mesh, resolve(parse_where("2"), mesh, no_snap)), (Vec3{1, 1, 0}));
  EXPECT_EQ(position(mesh, resolve(parse_where("f:1:.5,.5,0"), mesh, no_snap)), (Vec3{.5, .5, 0}));
  EXPECT_THROW(resolve(parse_where("f:2:.5,.5,0"), mesh, no_snap), Error);
  EXPECT_THROW(resolve(parse_where("f:1:.5,.6,0"), mesh, no_snap), Error);
  Vec3 asked;
  const auto snap = [&](Vec3 p) {
    asked = p;
    return SurfacePoint{1, {0, 1, 0}};
  };
  EXPECT_EQ(resolve(parse_where("at:1,2,3"), mesh, snap).face, 1u);
  EXPECT_EQ(asked, (Vec3{1, 2, 3}));
}

TEST(Where, AFileHasOnePlaceOrAListPerLineAndComments) {
  const std::string path = testing::TempDir() + "brushfire_places.txt";
  std::ofstream(path) << "# landmarks\n3\r\n\n  at:1,2,3@0.5  # the nose\nf:0:1,0,0\n8, 9\r\n";
  const std::vector<Where> places = read_where_file(path);
  ASSERT_EQ(places.size(), 5u);
  EXPECT_EQ(std::get<VertexPlace>(places[0].place).index, 3u);
  EXPECT_EQ(places[1].offset, 0.5);
  EXPECT_EQ(places[2].text, "f:0:1,0,0");
  EXPECT_EQ(std::get<VertexPlace>(places[4].place).index, 9u);
}

TEST(Where, AFileMayComeFromAnySystem) {
  const std::string path = testing::TempDir() + "brushfire_foreign_places.txt";
  for (const char* text : {"3\n4@1\n\n5", "3\r\n4@1\r\n\r\n5\r\n", "3\r4@1\r\r5\r",
                           "\xef\xbb\xbf"
                           "3\n4@1\n5"}) {
    std::ofstream(path, std::ios::binary) << text;
    const std::vector<Where> places = read_where_file(path);
    ASSERT_EQ(places.size(), 3u) << text;
    EXPECT_EQ(std::get<VertexPlace>(places[0].place).index, 3u);
    EXPECT_EQ(std::get<VertexPlace>(places[2].place).index, 5u);
  }
  EXPECT_THROW(read_where_file(testing::TempDir()), Error);
}

TEST(Where, ALineMayEndWhereABlockOfTheFileEnds) {
  // CR is the last byte of the first block that is read, LF the first of the second: still one line's end.
  const std::string path = testing::TempDir() + "brushfire_block_of_places.txt";
  std::ofstream(path, std::ios::binary) << '#' + std::string(65534, '.') + "\r\nnose\r\n";
  try {
    read_where_file(path);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).rfind(path + ":2: 'nose' is no place", 0), 0u) << e.what();
  }
}

TEST(Where, AFileErrorNamesFileAndLine) {
  const std::string path = testing::TempDir() + "brushfire_bad_places.txt";
  std::ofstream(path) << "3\n\nnose\n";
  try {
    read_where_file(path);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).rfind(path + ":3: 'nose' is no place", 0), 0u) << e.what();
  }
  EXPECT_THROW(read_where_file(testing::TempDir() + "no/such/file"), Error);
}

}  // namespace
}  // namespace brushfire::tool
