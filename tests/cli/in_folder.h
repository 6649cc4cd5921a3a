// Tests of the program that read and write files.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "io/io_support.h"

namespace brushfire::test {

// Every test has a folder of its own, which goes away with it.
class InFolder : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& content) const { write_file(path(name), content); }
  // Unit squares in OFF, row by row: vertex y * (columns + 1) + x, and two faces to a square, the lower one first.
  void write_squares(const std::string& name, int columns, int rows) const {
    const int side = columns + 1;
    std::string off = "OFF\n" + std::to_string(side * (rows + 1)) + " " + std::to_string(2 * columns * rows) + " 0\n";
    for (int v = 0; v < side * (rows + 1); ++v)
      off += std::to_string(v % side) + " " + std::to_string(v / side) + " 0\n";
    for (int v = 0; v < side * rows; ++v) {
      if (v % side == columns) continue;
      const std::string a = std::to_string(v), b = std::to_string(v + 1), c = std::to_string(v + side + 1),
                        d = std::to_string(v + side);
      off += "3 " + a + " " + b + " " + c + "\n3 " + a + " " + c + " " + d + "\n";
    }
    write(name, off);
  }
  std::string content(const std::string& name) const { return read_file(path(name)); }

 private:
  TemporaryDirectory folder_;
};

}  // namespace brushfire::test
