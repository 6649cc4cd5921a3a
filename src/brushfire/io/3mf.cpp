// 3MF: the objects that the build of a model names, their transforms applied, all in one mesh.
//
// Based on: 3MF Consortium, 3D Manufacturing Format, core specification 1.3, and production extension 1.2.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/formats.h>
#include <brushfire/io/detail/text.h>
#include <brushfire/io/detail/xml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#ifdef BRUSHFIRE_HAS_LIBZIP
#include <zip.h>
#endif

namespace brushfire::detail {

bool is_3mf(std::string_view bytes) {
  return bytes.substr(0, 4) == "PK\3\4" && bytes.find("3D/") != std::string_view::npos;
}

#ifdef BRUSHFIRE_HAS_LIBZIP

namespace {

// Row vectors times a 4 x 3 matrix, as 3MF writes it.
using Transform = std::array<double, 12>;
constexpr Transform kIdentity{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

Vec3 apply(const Transform& m, const Vec3& p) {
  return {p.x * m[0] + p.y * m[3] + p.z * m[6] + m[9], p.x * m[1] + p.y * m[4] + p.z * m[7] + m[10],
          p.x * m[2] + p.y * m[5] + p.z * m[8] + m[11]};
}

// First `a`, then `b`.
Transform product(const Transform& a, const Transform& b) {
  Transform m{};
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < 3; ++k) m[3 * r + c] += a[3 * r + k] * b[3 * k + c];
      if (r == 3) m[3 * r + c] += b[9 + c];
    }
  }
  return m;
}

// Parts name one another from the root of the archive.
std::string relative_name(const std::string& part) {
  return part.substr(std::min(part.find_first_not_of('/'), part.size()));
}

// The archive, in memory.
class Archive {
 public:
  explicit Archive(const Input& input) : input_(&input), budget_(input.inflate_budget()) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(input.bytes().data(), input.size(), 0, &error);
    if (source != nullptr) zip_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
    const std::string cause = zip_ ? "" : zip_error_strerror(&error);
    if (!zip_ && source != nullptr) zip_source_free(source);
    zip_error_fini(&error);
    if (!zip_) input.fail("zip: " + printable(cause));
  }

  // The content of the file of this name in the archive.
  std::string read(const std::string& name) {
    const std::string shown = "the archive's " + quote(name);
    const std::string relative = relative_name(name);
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_stat(zip_.get(), relative.c_str(), ZIP_FL_NOCASE, &stat) != 0 || (stat.valid & ZIP_STAT_SIZE) == 0) {
      input_->fail(shown + " is not there");
    }
    if (stat.size > budget_) input_->fail(shown + " inflates to far more than the file's size: refused");
    budget_ -= stat.size;
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(zip_.get(), stat.index, 0),
                                                                 zip_fclose);
    if (!file) input_->fail(shown + " cannot be opened: " + printable(zip_strerror(zip_.get())));
    std::string content(stat.size, '\0');
    std::size_t done = 0;
    while (done < content.size()) {
      const zip_int64_t got = zip_fread(file.get(), content.data() + done, content.size() - done);
      if (got <= 0) input_->fail(shown + " is damaged");
      done += static_cast<std::size_t>(got);
    }
    return content;
  }

 private:
  struct Discard {
    void operator()(zip_t* zip) const { zip_discard(zip); }
  };
  const Input* input_;
  std::size_t budget_;
  std::unique_ptr<zip_t, Discard> zip_;
};

// Another object, or one that is to be built.
struct Reference {
  std::string path;  // of the part that holds it; empty for the same
  std::uint64_t object = 0;
  Transform transform = kIdentity;
  std::size_t line = 0;
};

struct Object {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint64_t, 3>> triangles;
  std::vector<std::size_t> lines;  // of the triangles
  std::vector<Reference> components;
  bool is_support = false;
};

// One model part of the archive.
class ModelPart {
 public:
  ModelPart(const Input& input, const std::string& name, std::string content)
      : content_(std::move(content)), input_(Input::from_memory(content_, input.name() + "/" + relative_name(name))) {
    parse_xml(input_, "", [this](std::span<const XmlElement> path) { element(path); });
  }

  const Input& input() const { return input_; }
  std::map<std::uint64_t, Object> objects;
  std::vector<Reference> build;
  std::string unit = "millimeter";

 private:
  void element(std::span<const XmlElement> path) {
    const XmlElement& e = path.back();
    if (e.name == "vertex") {
      object_.vertices.push_back({coordinate(e, "x"), coordinate(e, "y"), coordinate(e, "z")});
    } else if (e.name == "triangle") {
      object_.triangles.push_back({needed(e, "v1"), needed(e, "v2"), needed(e, "v3")});
      object_.lines.push_back(e.line);
    } else if (e.name == "component") {
      object_.components.push_back(reference(e));
    } else if (e.name == "object") {
      const std::string_view type = e.attribute("type");
      object_.is_support = type == "support" || type == "other";
      objects.insert_or_assign(needed(e, "id"), std::move(object_));
      object_ = {};
    } else if (e.name == "item") {
      build.push_back(reference(e));
    } else if (e.name == "model") {
      if (!e.attribute("unit").empty()) unit = e.attribute("unit");
      check_extensions(e);
    }
  }

  // What a file requires and we do not know could change the shape.
  void check_extensions(const XmlElement& model) const {
    TextCursor prefixes(input_, model.attribute("requiredextensions"), model.line);
    while (prefixes.to_word()) {
      const std::string_view prefix = prefixes.word_here();
      const std::string_view name = model.attribute("xmlns:" + std::string(prefix));
      const bool is_known =
          name.find("/production/") != std::string_view::npos || name.find("/material/") != std::string_view::npos;
      if (!is_known) input_.fail_line(model.line, "requires the extension " + quote(name) + ", which is not read");
    }
  }

  Reference reference(const XmlElement& e) const {
    Reference r;
    r.object = needed(e, "objectid");
    r.line = e.line;
    for (const auto& [key, value] : e.attributes) {
      if (key.size() > 5 && key.compare(key.size() - 5, 5, ":path") == 0) r.path = value;
    }
    const std::string_view transform = e.attribute("transform");
    if (transform.empty()) return r;
    TextCursor text(input_, transform, e.line);
    for (double& m : r.transform) m = text.coordinate();
    return r;
  }

  double coordinate(const XmlElement& e, const char* key) const {
    TextCursor text(input_, e.attribute(key), e.line);
    return text.coordinate();
  }
  std::uint64_t needed(const XmlElement& e, const char* key) const {
    if (e.attribute(key).empty()) input_.fail_line(e.line, e.name + " without " + key);
    return e.count(input_, key);
  }

  std::string content_;
  Input input_;
  Object object_;
};

class Reader3mf {
 public:
  explicit Reader3mf(const Input& input) : input_(&input), archive_(input), budget_(input.inflate_budget()) {}

  MeshParts read() {
    const std::string main = main_part();
    const ModelPart& model = part(main);
    for (const Reference& item : model.build) add(main, item, kIdentity, 0);
    if (model.unit != "millimeter") parts_.remarks.push_back("the unit is the " + printable(model.unit));
    if (added_ > 1)
      parts_.remarks.push_back(std::to_string(added_) + " objects merged, their vertices one after the other");
    if (left_out_ != 0) parts_.remarks.push_back(counted(left_out_, "support object", "support objects") + " left out");
    return std::move(parts_);
  }

 private:
  // The part that the archive's relations name as the model.
  std::string main_part() {
    const std::string content = archive_.read("_rels/.rels");
    const Input relations = Input::from_memory(content, input_->name() + "/_rels/.rels");
    std::string target;
    parse_xml(relations, "", [&](std::span<const XmlElement> path) {
      constexpr std::string_view kModel = "/3dmodel";
      const XmlElement& e = path.back();
      const std::string_view type = e.attribute("Type");
      if (e.name == "Relationship" && type.size() > kModel.size() &&
          type.substr(type.size() - kModel.size()) == kModel) {
        target = e.attribute("Target");
      }
    });
    if (target.empty()) input_->fail("the archive names no 3D model");
    return target;
  }

  const ModelPart& part(const std::string& name) {
    auto& slot = models_[name];
    if (!slot) slot = std::make_unique<ModelPart>(*input_, name, archive_.read(name));
    return *slot;
  }

  void add(const std::string& from, const Reference& reference, const Transform& outer, int depth) {
    constexpr int kDeepest = 32;
    const Input& where = part(from).input();
    if (depth > kDeepest) where.fail_line(reference.line, "components are nested more than 32 deep");
    const std::string& name = reference.path.empty() ? from : reference.path;
    const ModelPart& model = part(name);
    const auto found = model.objects.find(reference.object);
    if (found == model.objects.end()) {
      where.fail_line(reference.line, "there is no object " + std::to_string(reference.object));
    }
    const Object& object = found->second;
    const Transform transform = product(reference.transform, outer);
    if (object.is_support) {
      ++left_out_;
      return;
    }
    if (!object.triangles.empty()) add_mesh(model.input(), object, transform);
    for (const Reference& component : object.components) {
      spend(sizeof(Reference));
      add(name, component, transform, depth + 1);
    }
  }

  // Many items may name one object: what comes out altogether is bounded by the file's size.
  void spend(std::size_t bytes) {
    if (bytes > budget_) input_->fail("the objects come to far more than the file's size: refused");
    budget_ -= bytes;
  }

  void add_mesh(const Input& where, const Object& object, const Transform& transform) {
    ++added_;
    spend(object.vertices.size() * sizeof(Vec3) + object.triangles.size() * sizeof(Face));
    const std::size_t first = parts_.positions.size();
    if (first + object.vertices.size() >= kNoIndex) {
      throw Error(ErrorCode::TooLarge, printable(input_->name()) + ": more than 2^32 vertices");
    }
    for (const Vec3& p : object.vertices) {
      const Vec3 q = apply(transform, p);
      if (!std::isfinite(q.x) || !std::isfinite(q.y) || !std::isfinite(q.z)) {
        input_->fail("a transform takes a vertex to infinity");
      }
      parts_.positions.push_back(q);
    }
    for (std::size_t f = 0; f < object.triangles.size(); ++f) {
      Face face;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint64_t v = object.triangles[f][k];
        if (v >= object.vertices.size()) {
          where.fail_line(object.lines[f], "a triangle names vertex " + std::to_string(v) + ", but there are " +
                                               std::to_string(object.vertices.size()));
        }
        face[k] = static_cast<Index>(first + v);
      }
      parts_.faces.add_triangle(face[0], face[1], face[2], object.lines[f]);
    }
  }

  const Input* input_;
  Archive archive_;
  std::size_t budget_;
  std::map<std::string, std::unique_ptr<ModelPart>> models_;
  MeshParts parts_;
  std::size_t added_ = 0, left_out_ = 0;
};

}  // namespace

MeshParts read_3mf(const Input& input) { return Reader3mf(input).read(); }

#else

MeshParts read_3mf(const Input& input) {
  input.fail("is 3MF, a zip archive, but this program was built without libzip");
}

#endif

}  // namespace brushfire::detail
