// Whole files at once.
#include <brushfire/io/detail/output.h>
#include <brushfire/io/write_bytes.h>

namespace brushfire {

void write_text(const std::string& path, std::string_view text) {
  detail::Output out(path);
  out.write(text);
  out.commit();
}

void write_bytes(const std::string& path, std::span<const std::uint8_t> bytes) {
  write_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace brushfire
