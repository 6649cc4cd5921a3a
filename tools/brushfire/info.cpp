// brushfire info: what is in a mesh.
#include "command_line.h"
#include "surface.h"

#include <brushfire/mesh/boundaries.h>
#include <brushfire/mesh/report.h>

#include <cstdio>
#include <memory>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire info scan.ply
  brushfire info scan.ply --json | jq .components
  zcat scan.off.gz | brushfire info -
  brushfire info part.stl --weld 1e-6
)";

struct Arguments {
  std::string file;
  SharedArguments shared;
};

void add_counts(Record& record, const MeshReport& r) {
  const auto add = [&](const char* key, long long value) { record.add(key, std::int64_t{value}); };
  add("vertices", r.vertices);
  add("faces", r.faces);
  add("edges", r.edges);
  add("components", r.components);
  add("euler_characteristic", r.euler_characteristic);
  add("boundary_edges", r.boundary_edges);
  add("nonmanifold_edges", r.nonmanifold_edges);
  add("nonmanifold_vertices", r.nonmanifold_vertices);
  add("misoriented_edges", r.misoriented_edges);
  add("isolated_vertices", r.isolated_vertices);
  add("zero_area_faces", r.zero_area_faces);
  add("zero_length_edges", r.zero_length_edges);
  add("repeated_index_faces", r.repeated_index_faces);
  add("duplicate_faces", r.duplicate_faces);
  add("duplicate_positions", r.duplicate_positions);
  add("near_positions", r.near_positions);
  record.add("near_tolerance", r.near_tolerance);
  record.add("looks_like_soup", r.looks_like_soup);
  record.add("min_edge_length", r.min_edge_length);
  record.add("mean_edge_length", r.mean_edge_length);
  record.add("max_edge_length", r.max_edge_length);
  record.add("area", r.area);
}

constexpr std::size_t kBoundariesShown = 8;

// The counts that say something about any mesh; the unusual ones stand in the remarks.
std::string in_words(const Arguments& a, const Surface& surface, const std::vector<std::string>& remarks) {
  const MeshReport& r = surface.mesh().report();
  const std::string unit = a.shared.unit.empty() ? "" : " " + a.shared.unit;
  std::string text = a.file + " (" + surface.file().format + ")\n";
  const auto line = [&](const char* name, const std::string& value) {
    char padded[32];
    std::snprintf(padded, sizeof padded, "  %-22s", name);
    text += padded + value + "\n";
  };
  line("vertices", std::to_string(r.vertices));
  line("faces", std::to_string(r.faces));
  line("edges", std::to_string(r.edges));
  line("components", std::to_string(r.components));
  line("Euler characteristic", std::to_string(r.euler_characteristic));
  line("edge length", readable(r.min_edge_length) + " .. " + readable(r.max_edge_length) + ", mean " +
                          readable(r.mean_edge_length) + unit);
  line("area", readable(r.area) + (unit.empty() ? "" : unit + "^2"));
  std::size_t number = 0;
  for (const Boundary& b : boundaries(surface.mesh())) {
    if (number == kBoundariesShown) {
      line("...", "--json lists all of them");
      break;
    }
    line(("boundary:" + std::to_string(number++)).c_str(), (b.closed ? "closed, " : "open, ") + readable(b.length) +
                                                               unit + " long, from vertex " +
                                                               std::to_string(b.vertices.front()));
  }
  if (surface.domain().has_walls()) {
    const OpenPart open = open_part(surface.domain());
    const std::string square = unit.empty() ? "" : unit + "^2";
    line("behind walls",
         counted(open.closed_faces, "face", "faces") + ", " + counted(open.closed_vertices, "vertex", "vertices"));
    line("open", readable(open.area) + square + " in " + counted(open.components, "component", "components") +
                     ", the largest " + readable(open.largest_area) + square);
    if (open.islanders > 0) {
      text += "  - " + counted(open.islanders, "open vertex is", "open vertices are") +
              " outside of the largest open component: no way leads there from it\n";
    }
    if (const Index left = surface.left_alone(); left > 0) {
      text += "  - " + counted(left, "vertex is", "vertices are") +
              " open by the mask, but in no face whose three vertices are: nothing reaches them\n";
    }
  }
  for (const std::string& remark : remarks) text += "  - " + remark + "\n";
  return text;
}

int info(const Arguments& arguments, const Talk& talk) {
  const Surface surface(arguments.file, arguments.shared);
  std::vector<std::string> remarks = surface.remarks();
  for (std::string& remark : surface.mesh().report().remarks()) remarks.push_back(std::move(remark));
  if (!talk.json) {
    write_stdout(in_words(arguments, surface, remarks));
    return kOk;
  }
  Record record;
  record.add("file", arguments.file).add("format", surface.file().format).add("unit", unit_of(arguments.shared));
  add_counts(record, surface.mesh().report());
  std::vector<Record> curves;
  for (const Boundary& b : boundaries(surface.mesh())) {
    curves.emplace_back()
        .add("length", b.length)
        .add("closed", b.closed)
        .add("vertices", static_cast<std::int64_t>(b.vertices.size()))
        .add("first_vertex", std::int64_t{b.vertices.front()});
  }
  record.add("boundaries", std::move(curves));
  if (surface.domain().has_walls()) {
    const OpenPart open = open_part(surface.domain());
    record.add("closed_faces", std::int64_t{open.closed_faces})
        .add("closed_vertices", std::int64_t{open.closed_vertices})
        .add("open_components", std::int64_t{open.components})
        .add("open_area", open.area)
        .add("largest_open_area", open.largest_area)
        .add("outside_largest", std::int64_t{open.islanders})
        .add("open_in_no_face", std::int64_t{surface.left_alone()});
  }
  record.add("remarks", remarks);
  write_stdout(record.json());
  return kOk;
}

}  // namespace

void add_info(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("info", "What is in a mesh: counts, sizes, and whatever is unusual", [&](Verb& verb) {
    add_surface(verb, arguments->file);
    verb.talks();
    add_shared(verb, arguments->shared,
               {.without = {{kWeights, "info computes no distances"},
                            {kStarting, "nothing starts here: info tells what is in the mesh"},
                            {kComputing, "info computes no distances"},
                            {{Shared::Scalar, Shared::Name}, "info reads a mesh and no values"}}});
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return info(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
