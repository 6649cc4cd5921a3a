// The file behind a glTF: its JSON, the bytes of its buffers, the numbers of its accessors.
#pragma once

#include <brushfire/io/detail/input.h>
#include <brushfire/io/detail/json.h>
#include <brushfire/io/detail/numbers.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace brushfire::detail {

// Everything is checked as it is asked for; what does not fit throws Error(FileMalformed), with the file's name.
class GltfFile {
 public:
  // Splits a GLB into its chunks and reads the JSON. `input` must outlive the file.
  explicit GltfFile(const Input& input);

  const Json& json() const { return json_; }

  [[noreturn]] void fail(const std::string& cause) const { input_->fail(cause); }

  // The element `index` of the top-level list `list`.
  const Json& item(const char* list, std::size_t index) const;

  // A whole number >= 0 in `object`; `needed` is one that must be there.
  std::optional<std::size_t> number(const Json& object, const char* key) const;
  std::size_t needed(const Json& object, const char* key) const;

  // The numbers of an accessor, `components` (1 or 3) to an element, sparse elements replaced.
  std::vector<double> accessor(std::size_t index, std::size_t components);

  // The bytes that a buffer view names, as they stand in the buffer.
  std::string_view range_of(const Json& view);

  // What may still come out of the file, in bytes: many primitives may share one accessor, so what comes out altogether
  // is bounded by the file's size.
  std::size_t budget() const { return budget_; }
  void spend(std::size_t bytes) { budget_ -= std::min(budget_, bytes); }

 private:
  // How numbers stand in a buffer view; stride 0: one element after the other.
  struct Layout {
    NumberType type;
    std::size_t count, components, stride;
  };
  struct Chunks {
    std::string_view json, binary;
    std::size_t json_begin = 0;
  };
  struct Buffer {
    std::size_t index;
    Input input;
    std::unique_ptr<std::vector<char>> storage;
  };

  static Chunks split(const Input& input);
  NumberType component_type(std::size_t code) const;
  void read_elements(const Json& object, const std::string& name, const Layout& layout, double scale, double* out);
  void apply_sparse(const Json& sparse, const std::string& name, Layout layout, double scale,
                    std::vector<double>& values);
  std::string_view view_bytes(const Json& view);
  std::string_view buffer_bytes(std::size_t index);

  const Input* input_;
  Chunks chunks_;
  Json json_;
  std::size_t budget_;
  std::vector<Buffer> buffers_;
  std::map<const Json*, std::vector<char>> unpacked_;  // buffer views
};

}  // namespace brushfire::detail
