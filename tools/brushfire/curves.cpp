// Curves from their names.
#include "curves.h"

#include "fields.h"
#include "interrupt.h"
#include "surface.h"

#include <brushfire/core/error.h>
#include <brushfire/io/read_lines.h>
#include <brushfire/mesh/boundaries.h>
#include <brushfire/queries/curve_sources.h>
#include <brushfire/queries/path.h>
#include <brushfire/queries/surface_curves.h>

#include <algorithm>
#include <array>

namespace brushfire::tool {
namespace {

using Kind = CurvePlace::Kind;

constexpr std::array<std::pair<std::string_view, Kind>, 5> kPrefixes{{{"boundary:", Kind::Boundary},
                                                                      {"path:", Kind::Path},
                                                                      {"chain:", Kind::Chain},
                                                                      {"region:", Kind::Region},
                                                                      {"curve:", Kind::File}}};
constexpr std::array<std::string_view, 5> kExtensions{".csv", ".json", ".obj", ".ply", ".vtp"};

// Between commas; the three numbers of f: and at: belong together.
std::vector<std::string> places_between_commas(std::string_view text) {
  std::vector<std::string> places;
  std::size_t more = 0;  // parts that the last one still needs
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view part = trimmed(text.substr(begin, end - begin));
    if (more > 0) {
      places.back() += "," + std::string(part);
      --more;
    } else {
      places.emplace_back(part);
      more = part.starts_with("f:") || part.starts_with("at:") ? 2 : 0;
    }
    begin = end + 1;
  }
  return places;
}

// The curves' places or numbers, read to see whether they can be.
void check(Kind kind, const std::string& text, const std::string& detail) {
  const auto fail = [&](const char* why) { refuse(in_quotes(text) + ": " + why); };
  const std::vector<std::string> places = places_between_commas(detail);
  const auto is_vertex = [](const std::string& p) {
    return !p.empty() && p.find_first_not_of("0123456789") == std::string::npos;
  };
  switch (kind) {
    case Kind::Boundary:
      if (!detail.empty() && !is_vertex(detail)) fail("boundary:2 is the third that brushfire info lists");
      break;
    case Kind::Path:
      if (places.size() < 2) fail("a path has two ends (path:0,250)");
      for (const std::string& p : places) {
        if (parse_where(p).has_offset) fail("what follows @ is for the whole curve, at its end");
      }
      break;
    case Kind::Chain:
      if (!std::all_of(places.begin(), places.end(), is_vertex)) fail("a chain is of vertices (chain:3,4,5)");
      break;
    case Kind::Region:
      if (const std::size_t colon = detail.rfind(':');
          colon == std::string::npos || colon == 0 || colon + 1 == detail.size()) {
        fail("a region is a file and labels (region:cortex.annot:precentral,postcentral)");
      }
      break;
    case Kind::File:
      if (detail.empty()) fail("which file?");
      break;
  }
}

SurfacePath path_of(const Surface& surface, PlaceFinder& finder, const Where& where, const std::string& detail) {
  std::vector<SurfacePoint> waypoints;
  for (const std::string& text : places_between_commas(detail)) {
    waypoints.push_back(finder.source(surface.place(parse_where(text))));
  }
  DistanceSolver solver(surface.domain());
  SurfacePath path = path_through(solver, waypoints, false, &cancel_token());
  if (path.points.empty()) refuse(in_quotes(where.text) + ": no way leads from one of these places to the next");
  return path;
}

SurfacePath chain_of(const Surface& surface, const Where& where, const std::string& detail) {
  std::vector<Index> chain;
  for (const std::string& text : places_between_commas(detail)) {
    const Where vertex = parse_where(text);
    const std::uint64_t number = std::get<VertexPlace>(vertex.place).index;
    if (number >= surface.file().mesh.vertex_count()) {
      throw Error(ErrorCode::IndexOutOfRange, in_quotes(where.text) + ": there is no vertex " + text +
                                                  ", the mesh has " +
                                                  std::to_string(surface.file().mesh.vertex_count()));
    }
    chain.push_back(surface.vertex(static_cast<Index>(number)));
  }
  const bool closed = chain.size() > 2 && chain.front() == chain.back();
  if (closed) chain.pop_back();
  try {
    return curve_along(surface.mesh(), chain, closed);
  } catch (const Error& e) {
    throw Error(e.code(), in_quotes(where.text) + ": " + e.what());
  }
}

CurveSource boundary_of(const Mesh& mesh, const Where& where, const std::string& detail) {
  const std::vector<Boundary> all = boundaries(mesh);
  if (detail.empty()) return curve_source(mesh, all);
  const std::uint64_t number = std::get<VertexPlace>(parse_where(detail).place).index;
  if (number < all.size()) return curve_source(mesh, std::span(all).subspan(static_cast<std::size_t>(number), 1));
  throw Error(ErrorCode::IndexOutOfRange, in_quotes(where.text) + ": the mesh has " +
                                              counted(all.size(), "boundary curve", "boundary curves") +
                                              " (brushfire info lists them)");
}

CurveSource region_of(const Surface& surface, const Where& where, const std::string& detail) {
  const std::size_t colon = detail.rfind(':');
  const std::string file = detail.substr(0, colon);
  const Mesh& mesh = surface.file().mesh;
  const LoadedField field = read_field(file);
  const std::vector<double> keys = keys_named(field, detail.substr(colon + 1), file, "region");
  const auto is_in = [&](double value) { return std::find(keys.begin(), keys.end(), value) != keys.end(); };
  const bool of_faces =
      field.vertices.empty() && field.values.size() != mesh.vertex_count() && field.values.size() == mesh.face_count();
  try {
    if (of_faces) {
      std::vector<Index> faces;
      for (Index f = 0; f < mesh.face_count(); ++f) {
        if (is_in(field.values[f])) faces.push_back(f);
      }
      return region_of_faces(surface.mesh(), faces);
    }
    std::vector<std::uint8_t> vertices(surface.mesh().vertex_count(), 0);
    const std::vector<double> values = values_of(field, file, mesh.vertex_count(), "the mesh");
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (is_in(values[v])) vertices[surface.vertex(v)] = 1;
    }
    return region_of_vertices(surface.mesh(), vertices);
  } catch (const Error& e) {
    throw Error(e.code(), in_quotes(where.text) + ": " + e.what());
  }
}

// Whether the points of a file are on this mesh: they then stand where the file has them.
bool is_on(const Mesh& mesh, const LoadedLine& line) {
  constexpr double kRounding = 1e-6;  // of the mesh's size: of text with six digits, and of 32-bit floats
  if (line.points.empty()) return false;
  if (line.positions.empty() || !mesh.has_positions()) return true;
  const double near = kRounding * norm(mesh.bounds().high - mesh.bounds().low);
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    if (line.points[i].face >= mesh.face_count()) return false;
    if (!(norm(position(mesh, line.points[i]) - line.positions[i]) <= near)) return false;
  }
  return true;
}

std::vector<Source> curves_in(const std::string& file, const Surface& surface, PlaceFinder& finder,
                              const Where& where) {
  const LoadedLines loaded = read_lines(file);
  if (loaded.lines.empty()) refuse(in_quotes(where.text) + ": there is no curve in this file");
  std::vector<Source> sources;
  double gap = 0;
  for (const LoadedLine& line : loaded.lines) {
    if (is_on(surface.mesh(), line)) {
      sources.push_back(source_along({.places = line.points, .closed = line.closed}, where.offset));
      continue;
    }
    const ProjectedCurve onto = project_curve(surface.domain(), line.positions, line.closed, &cancel_token());
    gap = std::max(gap, onto.largest_gap);
    sources.push_back(source_along(curve_source(onto.path), where.offset));
  }
  finder.moved(where, gap);
  return sources;
}

}  // namespace

std::optional<CurvePlace> parse_curve(std::string_view text) {
  text = trimmed(text);
  CurvePlace curve;
  const std::string whole(text);
  const auto prefix =
      std::find_if(kPrefixes.begin(), kPrefixes.end(), [&](const auto& p) { return text.starts_with(p.first); });
  const bool is_file = std::any_of(kExtensions.begin(), kExtensions.end(),
                                   [&](std::string_view e) { return text.size() > e.size() && text.ends_with(e); });
  if (prefix != kPrefixes.end()) {
    curve = {prefix->second, std::string(text.substr(prefix->first.size()))};
    if (curve.kind == Kind::Boundary && curve.detail.empty()) refuse(in_quotes(whole) + ": which one?");
  } else if (text == "boundary") {
    curve = {Kind::Boundary, ""};
  } else if (is_file) {
    curve = {Kind::File, whole};
  } else {
    return {};
  }
  check(curve.kind, whole, curve.detail);
  return curve;
}

std::vector<Source> curve_sources(const Surface& surface, PlaceFinder& finder, const Where& where) {
  const auto& [kind, detail] = std::get<CurvePlace>(where.place);
  const auto one = [&](CurveSource curve) { return std::vector{source_along(std::move(curve), where.offset)}; };
  switch (kind) {
    case Kind::Boundary:
      return one(boundary_of(surface.mesh(), where, detail));
    case Kind::Path:
      return one(curve_source(path_of(surface, finder, where, detail)));
    case Kind::Chain:
      return one(curve_source(chain_of(surface, where, detail)));
    case Kind::Region:
      return one(region_of(surface, where, detail));
    case Kind::File:
      return curves_in(detail, surface, finder, where);
  }
  return {};
}

}  // namespace brushfire::tool
