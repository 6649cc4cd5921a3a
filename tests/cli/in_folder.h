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
  std::string content(const std::string& name) const { return read_file(path(name)); }

 private:
  TemporaryDirectory folder_;
};

}  // namespace brushfire::test
