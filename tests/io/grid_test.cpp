// Grids go out and come back where they were.
#include <brushfire/core/error.h>
#include <brushfire/io/write_grid.h>

#include <gtest/gtest.h>

#include "io_support.h"

#include <array>
#include <filesystem>

namespace brushfire {
namespace {

Grid sample() {
  Grid grid;
  grid.columns = 3;
  grid.rows = 2;
  grid.heights = {0.1, -9999, 1e-300, kInfinity, 1.0 / 3, 7};
  grid.placement = {{1005, 2015}, {10, 0}, {0, -10}};
  return grid;
}

void expect_same(const Grid& a, const Grid& b) {
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.heights, b.heights);
  EXPECT_EQ(a.placement.origin, b.placement.origin);
  EXPECT_EQ(a.placement.right, b.placement.right);
  EXPECT_EQ(a.placement.down, b.placement.down);
}

TEST(Grid, AsciiComesBackToTheBitAlsoWhereAValueLooksLikeNoData) {
  const test::TemporaryDirectory folder;
  for (const double dy : {10.0, 2.5}) {
    Grid grid = sample();
    grid.placement.down = {0, -dy};
    const std::string file = folder / "a.asc";
    write_grid(file, grid);
    expect_same(read_grid(file), grid);
  }
}

Grid read_as(const std::string& name, const std::string& content) {
  const test::TemporaryDirectory folder;
  test::write_file(folder / name, content);
  return read_grid(folder / name);
}

std::string error_of_ascii(const std::string& content) {
  return test::error_of([&] { read_as("a.asc", content); });
}

TEST(Grid, AsciiIsReadAsEveryProgramAndSystemWritesIt) {
  const std::string plain = "ncols 2\nnrows 2\nxllcorner 5\nyllcorner 7\ncellsize 2\nNODATA_value -1\n0.5 +3\n-1 40\n";
  const Grid grid = read_as("a.asc", plain);
  EXPECT_EQ(grid.heights, (std::vector<double>{0.5, 3, kInfinity, 40}));
  EXPECT_EQ(grid.placement.origin, (std::array<double, 2>{6, 10}));
  const auto with = [&](const std::string& old, const std::string& fresh) {
    std::string text = plain;
    for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += fresh.size()) {
      text.replace(at, old.size(), fresh);
    }
    return text;
  };
  for (const std::string& text : {"\xef\xbb\xbf" + plain, with("\n", "\r\n"), with("\n", "\r"), with("\n", "\n\n"),
                                  with(" ", "\t"), with("\n", " "), with("ncols", "NCOLS"), with("40", "4.0D+01"),
                                  with("\n-1 ", "\n-1.#IND "), with("\n-1 ", "\nnan ")}) {
    expect_same(read_as("a.asc", text), grid);
  }
  expect_same(read_as("A.ASC", plain), grid);
  expect_same(read_as("heights.txt", plain), grid);
}

TEST(Grid, DefectsOfAsciiHaveTheirMessages) {
  const std::string head = "ncols 2\nnrows 2\n";
  const auto says = [](const std::string& content, const std::string& what) {
    const std::string message = error_of_ascii(content);
    EXPECT_NE(message.find(what), std::string::npos) << message;
  };
  says(head + "0 0\n0 \x1b[31mx", ":4: '\\x1b[31mx' where a height is expected");
  says(head + "0 0\n0 0\n7 8\n", ":5: '7' after the last of 2 rows of 2 heights");
  says(head + "0 0\n0   ", ":4: the file ends where a height is expected");
  says("ncols 100000\nnrows 100000\n0 0\n", "the number of heights is 10000000000, but only");
  says("ncols 2\n0 0\n0 0\n", "no nrows in the header");
  says("ncols 2.5\nnrows 2\n0 0\n0 0\n", "ncols is not a whole number from 2 on");
  says("ncols 2\nnrows two\n", ":2: 'two' where a number is expected");
  says(head + "cellsize 0\n0 0\n0 0\n", "the cells have no size");
  says(head + "xllcorner inf\n0 0\n0 0\n", "the corner of the grid is not finite");
  says(std::string("\xff\xfen\0", 4), "is text in UTF-16");
  says("", "no ncols in the header");
}

TEST(Grid, WhatIsNoFileIsRefusedAtOnce) {
  const test::TemporaryDirectory folder;
  std::filesystem::create_directory(folder / "a.asc");
  EXPECT_NE(test::error_of([&] { read_grid(folder / "a.asc"); }).find("a.asc"), std::string::npos);
  EXPECT_NE(test::error_of([&] { read_grid(folder / "absent.asc"); }).find("absent.asc"), std::string::npos);
}

TEST(Grid, ArraysComeBackWithoutTheirPlace) {
  const test::TemporaryDirectory folder;
  const std::string file = folder / "a.npy";
  write_grid(file, sample());
  EXPECT_EQ(read_grid(file).heights, sample().heights);
}

TEST(Grid, WhatAFormatCannotSayIsRefused) {
  const test::TemporaryDirectory folder;
  Grid turned = sample();
  turned.placement.right = {10, 1};
  EXPECT_THROW(write_grid(folder / "b.asc", turned), Error);
  Grid missing = sample();
  missing.heights.pop_back();
  EXPECT_THROW(write_grid(folder / "b.npy", missing), Error);
  EXPECT_THROW(write_grid(folder / "b.xyz", sample()), Error);
}

TEST(Grid, GeoTiffComesBackToTheBitInBuildsWithGdal) {
  const test::TemporaryDirectory folder;
  const std::string file = folder / "a.tif";
  Grid grid = sample();
  grid.placement.right = {10, 1};
  try {
    write_grid(file, grid);
  } catch (const Error& e) {
    ASSERT_EQ(e.code(), ErrorCode::UnknownFormat) << e.what();
    EXPECT_NE(std::string(e.what()).find("gdal_translate"), std::string::npos);
    EXPECT_THROW(read_grid(file), Error);
    GTEST_SKIP() << "this build has no GDAL (BRUSHFIRE_WITH_GDAL)";
  }
  expect_same(read_grid(file), grid);
  test::write_file(folder / "c.tif", "no raster");
  EXPECT_THROW(read_grid(folder / "c.tif"), Error);
  grid.reference = R"(GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],)"
                   R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]])";
  write_grid(file, grid);
  try {
    read_grid(file);
    FAIL() << "a map in degrees";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::InvalidArgument);
    EXPECT_NE(std::string(e.what()).find("degrees"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace brushfire
