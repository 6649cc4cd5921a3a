// Grids go out and come back where they were.
#include <brushfire/core/error.h>
#include <brushfire/io/write_grid.h>

#include <gtest/gtest.h>

#include "io_support.h"

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
