// .npy arrays in and out.
#include "io_support.h"

#include <brushfire/io/npy.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace brushfire {
namespace {

using test::bytes_of;
using test::error_of;
using test::TemporaryDirectory;

std::string npy(const std::string& header, const std::string& values) {
  const auto n = static_cast<std::uint16_t>(header.size());
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(n & 255) + static_cast<char>(n >> 8) + header + values;
}

std::string npy_error(const std::string& content) {
  return error_of([&] { read_npy(bytes_of(content), "a.npy"); });
}

TEST(Npy, DoublesComeBackBitExact) {
  const TemporaryDirectory dir;
  std::mt19937_64 random(1);
  std::vector<double> values{0.0, -0.0, kInfinity, -kInfinity, 5e-324, 1.7976931348623157e308};
  for (int k = 0; k < 1000; ++k) {
    double v;
    const std::uint64_t bits = random();
    std::memcpy(&v, &bits, sizeof v);
    if (!std::isnan(v)) values.push_back(v);
  }
  write_npy(dir / "a.npy", values);
  const NpyArray array = read_npy(dir / "a.npy");
  EXPECT_EQ(array.shape, (std::vector<std::size_t>{values.size()}));
  EXPECT_EQ(array.type, "<f8");
  ASSERT_EQ(array.values.size(), values.size());
  EXPECT_EQ(std::memcmp(array.values.data(), values.data(), values.size() * sizeof(double)), 0);
}

TEST(Npy, NoIndexIsWrittenAsMinusOneInInt32) {
  const TemporaryDirectory dir;
  const std::vector<Index> labels{0, 7, kNoIndex};
  write_npy(dir / "a.npy", labels);
  const NpyArray array = read_npy(dir / "a.npy");
  EXPECT_EQ(array.type, "<i4");
  EXPECT_EQ(array.values, (std::vector<double>{0, 7, -1}));
}

TEST(Npy, MatrixKeepsItsShapeAndTheHeaderIsAligned) {
  const TemporaryDirectory dir;
  const std::vector<double> values{1, 2, 3, 4, 5, 6};
  const std::vector<std::size_t> shape{2, 3};
  write_npy(dir / "a.npy", values, shape);
  EXPECT_EQ(read_npy(dir / "a.npy").shape, shape);
  EXPECT_EQ(test::read_file(dir / "a.npy").size() % 64, values.size() * 8 % 64);
}

TEST(Npy, FortranOrderIsTurnedIntoCOrder) {
  const std::string values = "\x01\x04\x02\x05\x03\x06";
  const NpyArray array =
      read_npy(bytes_of(npy("{'descr': '|u1', 'fortran_order': True, 'shape': (2, 3), }", values)), "a.npy");
  EXPECT_EQ(array.values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST(Npy, BigEndianAndHalfPrecisionAreRead) {
  const NpyArray big = read_npy(
      bytes_of(npy("{'descr': '>i2', 'fortran_order': False, 'shape': (2,), }", std::string("\x01\x00\xff\xfe", 4))),
      "a.npy");
  EXPECT_EQ(big.values, (std::vector<double>{256, -2}));
  const NpyArray half = read_npy(bytes_of(npy("{'descr': '<f2', 'fortran_order': False, 'shape': (4,), }",
                                              std::string("\x00\x3c\x00\xc0\x00\x7c\x01\x00", 8))),
                                 "a.npy");
  EXPECT_EQ(half.values, (std::vector<double>{1, -2, kInfinity, std::ldexp(1.0, -24)}));
}

TEST(Npy, EveryDefectHasItsMessage) {
  const std::string start = "{'descr': '<f8', 'fortran_order': False, ";
  EXPECT_EQ(npy_error(""), "file_malformed: a.npy: byte 0: the file does not start like a .npy file");
  EXPECT_EQ(npy_error(npy(start + "'shape': (2,), }", std::string(8, 'x'))),
            "file_malformed: a.npy: byte 67: the shape asks for more values than the 8 bytes that follow");
  EXPECT_EQ(npy_error(npy(start + "'shape': (1,), }", std::string(9, 'x'))),
            "file_malformed: a.npy: byte 67: 9 bytes follow, but the shape asks for 8");
  EXPECT_EQ(npy_error(npy(start + "'shape': (4294967296,4294967296,), }", "")),
            "file_malformed: a.npy: byte 87: the shape asks for more values than the 0 bytes that follow");
  EXPECT_EQ(npy_error(npy(start + "'shape': (18446744073709551616,), }", "")),
            "file_malformed: a.npy: byte 81: a dimension is beyond 64 bits");
  EXPECT_EQ(npy_error(npy("{'descr': '|O', 'fortran_order': False, 'shape': (0,), }", "")),
            "file_malformed: a.npy: byte 10: numbers of type '|O' are not read");
  EXPECT_EQ(npy_error(npy("{'descr': '<c16', 'fortran_order': False, 'shape': (0,), }", "")),
            "file_malformed: a.npy: byte 10: numbers of type '<c16' are not read");
  EXPECT_EQ(
      npy_error(npy("{'descr': '<i8', 'fortran_order': False, 'shape': (1,), }", std::string(7, '\xff') + "\x7f")),
      "file_malformed: a.npy: byte 67: the integer 9223372036854775807 is beyond 2^53");
  EXPECT_EQ(npy_error(npy("{'descr': ", "")), "file_malformed: a.npy: byte 20: the header ends early");
}

}  // namespace
}  // namespace brushfire
