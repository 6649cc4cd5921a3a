// NumPy's .npy: arrays of numbers in and out.
#pragma once

#include <brushfire/core/types.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace brushfire {

// An array of any shape in C order: values[product of shape]. Integers up to 2^53 and all floats are exact as doubles.
struct NpyArray {
  std::vector<std::size_t> shape;  // empty for a single number
  std::vector<double> values;
  std::string type;  // as in the file: "<f8", "|b1", ...
};

// Reads .npy of version 1 to 3: float16/32/64, signed and unsigned integers of 8 to 64 bits, bool; both byte orders, C
// and Fortran order (turned into C order). Anything else (objects, strings, complex numbers) is Error(FileMalformed),
// and so is an integer beyond 2^53, which a double does not hold. "-" is standard input.
NpyArray read_npy(const std::string& path);
NpyArray read_npy(std::span<const std::byte> content, const std::string& name);

// Writes version 1.0, little-endian, C order: float64, and int32 (where kNoIndex reads -1). `shape` must multiply to
// the number of values; empty means one row of all. The file appears complete or not at all; "-" is standard output.
// Throws Error(FileNotWritable).
void write_npy(const std::string& path, std::span<const double> values, std::span<const std::size_t> shape = {});
void write_npy(const std::string& path, std::span<const std::int32_t> values, std::span<const std::size_t> shape = {});
void write_npy(const std::string& path, std::span<const Index> values, std::span<const std::size_t> shape = {});

}  // namespace brushfire
