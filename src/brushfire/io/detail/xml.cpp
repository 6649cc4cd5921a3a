// The XML stream, on expat.
#include <brushfire/core/error.h>
#include <brushfire/io/detail/xml.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <memory>

#ifdef BRUSHFIRE_HAS_EXPAT
#include <expat.h>
#endif

namespace brushfire::detail {

std::string_view XmlElement::attribute(std::string_view key) const {
  for (const auto& [name_of_attribute, value] : attributes) {
    if (name_of_attribute == key) return value;
  }
  return {};
}

std::uint64_t XmlElement::count(const Input& input, std::string_view key, std::uint64_t otherwise) const {
  const std::string_view text = attribute(key);
  if (text.empty()) return otherwise;
  std::uint64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) {
    input.fail_line(line, std::string(key) + " is " + quote(text) + ", not a number");
  }
  return value;
}

#ifdef BRUSHFIRE_HAS_EXPAT

namespace {

constexpr std::size_t kDeepest = 64;

// Places in the input. Newer expats have functions of 64 bits on every machine and deprecate the others, whatever their
// version number says (distributions backport them): `requires` looks whether they are there.
template <class Parser>
std::size_t line_number(Parser* parser) {
  if constexpr (requires { XML_GetCurrentLineNumber64(parser); }) {
    return static_cast<std::size_t>(XML_GetCurrentLineNumber64(parser));
  } else {
    return static_cast<std::size_t>(XML_GetCurrentLineNumber(parser));
  }
}

template <class Parser>
std::size_t byte_index(Parser* parser) {
  if constexpr (requires { XML_GetCurrentByteIndex64(parser); }) {
    return static_cast<std::size_t>(XML_GetCurrentByteIndex64(parser));
  } else {
    return static_cast<std::size_t>(XML_GetCurrentByteIndex(parser));
  }
}

template <class Parser>
std::size_t byte_count(Parser* parser) {
  if constexpr (requires { XML_GetCurrentByteCount64(parser); }) {
    return static_cast<std::size_t>(XML_GetCurrentByteCount64(parser));
  } else {
    return static_cast<std::size_t>(XML_GetCurrentByteCount(parser));
  }
}

class XmlStream {
 public:
  XmlStream(const Input& input, std::string_view stop_at,
            const std::function<void(std::span<const XmlElement>)>& finished)
      : input_(&input),
        begin_(std::min(input.bytes().find_first_not_of(" \t\r\n"), input.size())),
        stop_at_(stop_at),
        finished_(&finished),
        parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), start, end);
    XML_SetEntityDeclHandler(parser_.get(), entity);
  }

  std::size_t parse() {
    constexpr std::size_t kChunk = std::size_t{1} << 30;  // expat counts in int
    const std::string_view bytes = input_->bytes();
    for (std::size_t at = begin_; !stopped_;) {
      const std::size_t size = std::min(kChunk, bytes.size() - at);
      const bool last = at + size == bytes.size();
      const XML_Status status = XML_Parse(parser_.get(), bytes.data() + at, static_cast<int>(size), last);
      if (error_) std::rethrow_exception(error_);
      if (status == XML_STATUS_ERROR && !stopped_) {
        input_->fail_line(line(), std::string("XML: ") + XML_ErrorString(XML_GetErrorCode(parser_.get())));
      }
      at += size;
      if (last) break;
    }
    return stopped_ ? stopped_at_ : bytes.size();
  }

 private:
  // Exceptions must not pass through expat, which is C: they wait until it has returned.
  template <class Run>
  void guarded(Run&& run) {
    try {
      run();
    } catch (...) {
      error_ = std::current_exception();
      XML_StopParser(parser_.get(), XML_FALSE);
    }
  }

  std::size_t line() const {
    const std::string_view before = input_->bytes().substr(0, begin_);
    return line_number(parser_.get()) + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  }
  std::size_t byte() const { return begin_ + byte_index(parser_.get()); }

  static void XMLCALL start(void* self, const XML_Char* name, const XML_Char** attributes) {
    auto& s = *static_cast<XmlStream*>(self);
    if (s.error_ || s.stopped_) return;
    s.guarded([&] {
      if (s.path_.size() == kDeepest) s.input_->fail_line(s.line(), "elements are nested more than 64 deep");
      if (!s.path_.empty() && !s.path_.back().has_children) {
        s.path_.back().has_children = true;
        s.path_.back().text_end = s.byte();
      }
      XmlElement e;
      e.name = name;
      e.line = s.line();
      e.text_begin = s.byte() + byte_count(s.parser_.get());
      for (; *attributes != nullptr; attributes += 2) e.attributes.emplace_back(attributes[0], attributes[1]);
      s.path_.push_back(std::move(e));
      if (s.path_.back().name == s.stop_at_) {
        s.stopped_at_ = s.path_.back().text_begin;
        (*s.finished_)(s.path_);
        s.stopped_ = true;
        XML_StopParser(s.parser_.get(), XML_FALSE);
      }
    });
  }

  static void XMLCALL end(void* self, const XML_Char*) {
    auto& s = *static_cast<XmlStream*>(self);
    if (s.error_ || s.stopped_ || s.path_.empty()) return;
    s.guarded([&] {
      XmlElement& e = s.path_.back();
      if (!e.has_children) e.text_end = std::max(s.byte(), e.text_begin);  // <a/> ends where it starts
      (*s.finished_)(s.path_);
      s.path_.pop_back();
    });
  }

  static void XMLCALL entity(void* self, const XML_Char*, int, const XML_Char*, int, const XML_Char*, const XML_Char*,
                             const XML_Char*, const XML_Char*) {
    auto& s = *static_cast<XmlStream*>(self);
    s.guarded([&] { s.input_->fail_line(s.line(), "declares an entity, which is refused"); });
  }

  const Input* input_;
  std::size_t begin_;  // of what XML calls the document: some files have white space before it
  std::string_view stop_at_;
  const std::function<void(std::span<const XmlElement>)>* finished_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::vector<XmlElement> path_;
  bool stopped_ = false;
  std::size_t stopped_at_ = 0;
  std::exception_ptr error_;
};

}  // namespace

std::size_t parse_xml(const Input& input, std::string_view stop_at,
                      const std::function<void(std::span<const XmlElement>)>& finished) {
  // Places of text are taken as byte numbers of the input, which holds for encodings of one byte per ASCII character.
  const std::string_view start = input.bytes().substr(0, 2);
  if (start == "\xff\xfe" || start == "\xfe\xff" || start.find('\0') != std::string_view::npos) {
    input.fail_byte(0, "XML in UTF-16 is not read");
  }
  return XmlStream(input, stop_at, finished).parse();
}

#else

std::size_t parse_xml(const Input& input, std::string_view, const std::function<void(std::span<const XmlElement>)>&) {
  input.fail("is an XML format, but this program was built without expat");
}

#endif

}  // namespace brushfire::detail
