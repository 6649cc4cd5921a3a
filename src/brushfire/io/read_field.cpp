// Which format a field has, and the formats that hold numbers only: .npy, CSV, text, JSON.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/csv.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/text.h>
#include <brushfire/io/formats.h>
#include <brushfire/io/npy.h>
#include <brushfire/io/read_field.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

namespace brushfire {

namespace detail {

LoadedField read_npy_field(const Input& input, const std::string&) {
  NpyArray array = read_npy(std::as_bytes(std::span(input.bytes())), input.name());
  const std::size_t columns = array.shape.size() == 2 ? array.shape[1] : 1;
  if (array.shape.empty() || array.shape.size() > 2 || columns != 1) {
    input.fail("an array of " + std::to_string(array.shape.size()) + " dimensions is not one value per vertex");
  }
  LoadedField field;
  field.values = std::move(array.values);
  return field;
}

LoadedField read_text_field(const Input& input, const std::string&) {
  TextCursor text(input, input.bytes(), 1, '#');
  LoadedField field;
  while (text.to_word()) field.values.push_back(text.number_here("a number"));
  return field;
}

namespace {

constexpr std::size_t kNoColumn = static_cast<std::size_t>(-1);

// Which columns hold the vertex and the value.
struct CsvColumns {
  std::size_t vertex = kNoColumn, value = kNoColumn;
};

CsvColumns columns_of(const CsvRows& rows, const std::vector<std::string_view>& header, const std::string& name) {
  CsvColumns columns;
  for (std::size_t k = 0; k < header.size(); ++k) {
    if (header[k] == "vertex") {
      columns.vertex = k;
    } else if (columns.value == kNoColumn && (name.empty() || header[k] == name)) {
      columns.value = k;
    }
  }
  if (columns.value == kNoColumn)
    rows.fail(name.empty() ? "the header names no column of values" : "there is no column " + quote(name));
  return columns;
}

}  // namespace

LoadedField read_csv_field(const Input& input, const std::string& name) {
  CsvRows rows(input);
  LoadedField field;
  std::vector<std::string_view> cells;
  if (!rows.next(cells)) return field;
  CsvColumns columns;
  double value = 0;
  const bool has_header =
      std::none_of(cells.begin(), cells.end(), [&](std::string_view c) { return rows.is_number(c, value); });
  if (has_header) {
    columns = columns_of(rows, cells, name);
    field.name = cells[columns.value];
  } else {
    if (!name.empty()) rows.fail("there is no header, and no column " + quote(name));
    if (cells.size() > 2) rows.fail(std::to_string(cells.size()) + " columns without a header: which one is it?");
    columns.value = cells.size() - 1;  // alone, or behind the vertex
    if (cells.size() == 2) columns.vertex = 0;
  }
  const std::size_t width = cells.size();
  for (bool more = !has_header || rows.next(cells); more; more = rows.next(cells)) {
    if (cells.size() != width)
      rows.fail(counted(cells.size(), "cell", "cells") + ", but the first line has " + std::to_string(width));
    field.values.push_back(rows.number(cells[columns.value]));
    if (columns.vertex == kNoColumn) continue;
    const double v = rows.number(cells[columns.vertex]);
    if (!(v >= 0) || v >= static_cast<double>(kNoIndex) || v != std::floor(v))
      rows.fail(quote(cells[columns.vertex]) + " is no vertex number");
    field.vertices.push_back(static_cast<Index>(v));
  }
  return field;
}

namespace {

// Picks one list of numbers out of JSON as it streams by: memory is that of the list.
class JsonList : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonList(const Input& input, const std::string& wanted) : input_(&input), wanted_(&wanted) {}

  LoadedField field;
  bool found = false;

  // What only makes sense when all was read.
  void check() const {
    for (const Index v : field.not_visited) {
      if (v >= field.values.size() || field.values[v] != kInfinity) {
        input_->fail("vertex " + std::to_string(v) + " in " + quote(kNotVisited) + " is not null in " +
                     quote(field.name));
      }
    }
  }

  bool null() override { return add(kInfinity); }
  bool boolean(bool v) override { return add(v ? 1 : 0); }
  bool number_integer(number_integer_t v) override { return add(static_cast<double>(v)); }
  bool number_unsigned(number_unsigned_t v) override {
    if (!in_not_visited_) return add(static_cast<double>(v));
    // Larger numbers are vertices of no file, and stay so.
    field.not_visited.push_back(static_cast<Index>(std::min<number_unsigned_t>(v, kNoIndex)));
    return true;
  }
  bool number_float(number_float_t v, const string_t&) override { return add(v); }
  bool string(string_t&) override {
    if (inside_) input_->fail("the list " + quote(field.name) + " holds a string");
    return true;
  }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return open(); }
  bool end_object() override { return --depth_, true; }
  bool key(string_t& k) override {
    if (depth_ == 1) key_ = k;
    return true;
  }
  bool start_array(std::size_t) override {
    const bool is_it = depth_ <= 1 && !found && (wanted_->empty() || key_ == *wanted_);
    if (is_it) {
      inside_ = found = true;
      field.name = key_;
    }
    in_not_visited_ = !is_it && depth_ == 1 && key_ == kNotVisited;
    return open();
  }
  bool end_array() override {
    inside_ = in_not_visited_ = false;
    return --depth_, true;
  }
  bool parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception&) override {
    input_->fail_byte(byte > 0 ? byte - 1 : 0, "not JSON");
  }

 private:
  bool add(double v) {
    if (in_not_visited_) input_->fail(quote(kNotVisited) + " holds what is no vertex number");
    if (inside_) field.values.push_back(v);
    return true;
  }
  bool open() {
    constexpr int kDeepest = 64;
    if (++depth_ > kDeepest) input_->fail("JSON is nested more than 64 deep");
    if (inside_ && depth_ > 2) input_->fail("the list " + quote(field.name) + " holds other lists");
    return true;
  }

  const Input* input_;
  const std::string* wanted_;
  std::string key_;
  int depth_ = 0;
  bool inside_ = false, in_not_visited_ = false;
};

}  // namespace

LoadedField read_json_field(const Input& input, const std::string& name) {
  JsonList list(input, name);
  nlohmann::json::sax_parse(input.bytes().begin(), input.bytes().end(), &list);
  if (!list.found) input.fail(name.empty() ? "has no list of numbers" : "has no list " + quote(name));
  list.check();
  return std::move(list.field);
}

namespace {

bool starts_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

struct FieldFormat {
  const char* name;
  std::initializer_list<std::string_view> extensions;
  LoadedField (*read)(const Input& input, const std::string& name);
};

// A new reader is one line here.
const FieldFormat kFormats[]{
    {"NPY", {"npy"}, read_npy_field},
    {"CSV", {"csv", "tsv"}, read_csv_field},
    {"text", {"txt", "dat", "asc", "1d"}, read_text_field},
    {"JSON", {"json"}, read_json_field},
    {"GIFTI", {"gii"}, read_gifti_field},
    {"FreeSurfer annotation", {"annot"}, read_freesurfer_annot},
    {"FreeSurfer label", {"label"}, read_freesurfer_label},
    {"FreeSurfer curvature", {"curv", "sulc", "thickness", "area", "volume", "avg_curv"}, read_freesurfer_curv},
    {"PLY", {"ply"}, read_ply_field},
    {"VTK", {"vtk"}, read_vtk_field},
    {"VTP", {"vtp"}, read_vtp_field},
    {"VTU", {"vtu"}, read_vtp_field},
};

const FieldFormat* format_named(std::string_view name) {
  for (const FieldFormat& f : kFormats) {
    if (name == f.name) return &f;
  }
  return nullptr;
}

const FieldFormat* format_by_content(std::string_view bytes) {
  if (starts_with(bytes, "\x93NUMPY")) return format_named("NPY");
  if (starts_with(bytes, "\xff\xff\xff")) return format_named("FreeSurfer curvature");
  const std::string_view text = text_start(bytes);
  if (starts_with(text, "ply\n") || starts_with(text, "ply\r")) return format_named("PLY");
  if (starts_with(text, "# vtk DataFile")) return format_named("VTK");
  if (starts_with(text, "<")) {
    const std::string_view head = text.substr(0, 1024);
    if (head.find("<GIFTI") != std::string_view::npos) return format_named("GIFTI");
    if (head.find("<VTKFile") != std::string_view::npos)
      return format_named(head.find("\"UnstructuredGrid\"") != std::string_view::npos ? "VTU" : "VTP");
  }
  return nullptr;
}

// For files without a telling name, as on standard input.
const FieldFormat* format_by_look(std::string_view bytes) {
  const std::string_view text = text_start(bytes), line = text.substr(0, text.find_first_of("\r\n"));
  if (starts_with(line, "#!ascii label")) return format_named("FreeSurfer label");
  if (starts_with(line, "{") || starts_with(line, "[")) return format_named("JSON");
  if (starts_with(line, "vertex") || line.find_first_not_of("0123456789+-.eEdDinfan,; \t") == std::string_view::npos) {
    return format_named(line.find_first_of(",;") != std::string_view::npos ? "CSV" : "text");
  }
  return starts_with(line, "#") ? format_named("text") : nullptr;
}

LoadedField read(Input input, const std::string& name) {
  input.drop_byte_order_mark();
  if (input.size() == 0) input.fail("the file is empty");
  const FieldFormat* format = format_by_content(input.bytes());
  const std::string extension = input.extension();
  std::string known;
  for (const FieldFormat& f : kFormats) {
    known += std::string(known.empty() ? "" : ", ") + f.name;
    const bool is_named = std::find(f.extensions.begin(), f.extensions.end(), extension) != f.extensions.end();
    if (format == nullptr && is_named) format = &f;
  }
  if (format == nullptr) format = format_by_look(input.bytes());
  if (format == nullptr) {
    throw Error(
        ErrorCode::UnknownFormat,
        printable(input.name()) + ": neither name nor content tell the format of the values (known: " + known + ")");
  }
  LoadedField field = format->read(input, name);
  field.format = format->name;
  return field;
}

}  // namespace

}  // namespace detail

std::vector<FileFormat> fields_read() {
  std::vector<FileFormat> formats;
  for (const detail::FieldFormat& f : detail::kFormats) {
    formats.push_back({f.name, {f.extensions.begin(), f.extensions.end()}});
  }
  return formats;
}

LoadedField read_field(const std::string& path, const std::string& name) {
  return detail::read(detail::Input::from_file(path), name);
}

LoadedField read_field(std::span<const std::byte> content, const std::string& file_name, const std::string& name) {
  return detail::read(
      detail::Input::from_memory({reinterpret_cast<const char*>(content.data()), content.size()}, file_name), name);
}

std::vector<double> values_on_vertices(const LoadedField& field, Index vertex_count, double otherwise) {
  if (field.vertices.empty()) {
    if (field.values.size() != vertex_count) {
      throw Error(ErrorCode::InvalidArgument,
                  std::to_string(field.values.size()) + " values for " + std::to_string(vertex_count) + " vertices");
    }
    return field.values;
  }
  std::vector<double> values(vertex_count, otherwise);
  for (std::size_t k = 0; k < field.vertices.size(); ++k) {
    if (field.vertices[k] >= vertex_count) {
      throw Error(ErrorCode::IndexOutOfRange, "entry " + std::to_string(k) + " names vertex " +
                                                  std::to_string(field.vertices[k]) + ", but there are " +
                                                  std::to_string(vertex_count));
    }
    values[field.vertices[k]] = field.values[k];
  }
  return values;
}

}  // namespace brushfire
