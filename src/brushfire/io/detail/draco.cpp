// What Draco unpacks, and what to say without it.
//
// Based on: Draco bitstream specification 2.2, sections 4 and 5 (the header, and the counts behind it).
#include <brushfire/io/detail/draco.h>

#ifdef BRUSHFIRE_HAS_DRACO
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#endif

#include <array>
#include <memory>
#include <utility>

namespace brushfire::detail {

#ifdef BRUSHFIRE_HAS_DRACO

namespace {

// The counts at the start of a stream, which the decoder takes memory for before it has seen the data.
struct Counts {
  bool ok = false;
  std::uint64_t points = 0, faces = 0;
};

// Seven bits to a byte, the lowest first.
bool read_varint(std::string_view& bytes, std::uint64_t& value) {
  value = 0;
  for (int shift = 0; shift < 63 && !bytes.empty(); shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes[0]);
    bytes.remove_prefix(1);
    value |= std::uint64_t{byte & 127u} << shift;
    if (byte < 128) return true;
  }
  return false;
}

Counts counts_of(std::string_view bytes) {
  constexpr std::size_t kHeader = 11;
  Counts counts;
  if (bytes.size() < kHeader || bytes.substr(0, 5) != "DRACO") return counts;
  const bool is_mesh = bytes[7] == 1, is_edgebreaker = bytes[8] == 1;
  const bool has_metadata = (static_cast<unsigned char>(bytes[10]) & 128u) != 0;
  const bool is_known = bytes[5] == 2 && bytes[6] == 2;  // the version
  if (!is_mesh || has_metadata || !is_known) return counts;
  bytes.remove_prefix(kHeader);
  if (is_edgebreaker) {
    if (bytes.empty()) return counts;
    bytes.remove_prefix(1);  // how it walks
    counts.ok = read_varint(bytes, counts.points) && read_varint(bytes, counts.faces);
  } else {
    counts.ok = read_varint(bytes, counts.faces) && read_varint(bytes, counts.points);
  }
  return counts;
}

}  // namespace

bool has_draco() { return true; }

std::string unpack_draco(std::string_view packed, std::uint32_t position, std::size_t most, DracoMesh& out) {
  const Counts counts = counts_of(packed);
  if (!counts.ok) return "is no mesh of Draco 2.2 without metadata";
  if (counts.points > most || counts.faces > most) return "unpacks to far more than the file's size: refused";
  draco::DecoderBuffer buffer;
  buffer.Init(packed.data(), packed.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return "cannot be unpacked";
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(position);
  if (attribute == nullptr || attribute->num_components() != 3) return "has no such positions";
  for (draco::PointIndex p(0); p < mesh->num_points(); ++p) {
    std::array<double, 3> xyz{};
    if (!attribute->ConvertValue<double>(attribute->mapped_index(p), 3, xyz.data())) return "has no such positions";
    out.positions.insert(out.positions.end(), xyz.begin(), xyz.end());
  }
  for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f) {
    for (const draco::PointIndex& p : mesh->face(f)) out.corners.push_back(p.value());
  }
  return {};
}

#else

bool has_draco() { return false; }

std::string unpack_draco(std::string_view, std::uint32_t, std::size_t, DracoMesh&) {
  return "is not read: this program was built without it";
}

#endif

}  // namespace brushfire::detail
