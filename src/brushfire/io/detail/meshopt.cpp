// What meshoptimizer unpacks, and what to say without it.
#include <brushfire/io/detail/meshopt.h>

#ifdef BRUSHFIRE_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace brushfire::detail {

#ifdef BRUSHFIRE_HAS_MESHOPTIMIZER

namespace {

// The functions behind take these for granted.
bool is_possible(const MeshoptView& view) {
  if (view.mode == "ATTRIBUTES") return view.stride >= 4 && view.stride <= 256 && view.stride % 4 == 0;
  const bool is_list = view.mode == "TRIANGLES" || view.mode == "INDICES";
  return is_list && (view.stride == 2 || view.stride == 4) && (view.mode == "INDICES" || view.count % 3 == 0);
}

bool apply_filter(const MeshoptView& view, std::vector<char>& out) {
  if (view.filter == "NONE") return true;
  if (view.mode != "ATTRIBUTES") return false;
  if (view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) {
    meshopt_decodeFilterOct(out.data(), view.count, view.stride);
  } else if (view.filter == "QUATERNION" && view.stride == 8) {
    meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
  } else if (view.filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(out.data(), view.count, view.stride);
  } else {
    return false;
  }
  return true;
}

}  // namespace

bool has_meshopt() { return true; }

std::string unpack_meshopt(const MeshoptView& view, std::string_view packed, std::vector<char>& out) {
  if (!is_possible(view)) return "is packed in a way that does not exist";
  const auto* bytes = reinterpret_cast<const unsigned char*>(packed.data());
  using Unpack = int (*)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t);
  const Unpack unpack = view.mode == "ATTRIBUTES"  ? Unpack{meshopt_decodeVertexBuffer}
                        : view.mode == "TRIANGLES" ? Unpack{meshopt_decodeIndexBuffer}
                                                   : Unpack{meshopt_decodeIndexSequence};
  if (unpack(out.data(), view.count, view.stride, bytes, packed.size()) != 0) return "cannot be unpacked";
  return apply_filter(view, out) ? "" : "has a filter that does not exist";
}

#else

bool has_meshopt() { return false; }

std::string unpack_meshopt(const MeshoptView&, std::string_view, std::vector<char>&) {
  return "is packed by EXT_meshopt_compression, which this program was built without";
}

#endif

}  // namespace brushfire::detail
