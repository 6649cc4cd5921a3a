// Large meshes, and meshes from files.
#include "corpus/dice.h"
#include "corpus/laws.h"
#include "corpus/mutations.h"
#include "oracle/zoo.h"

#include <brushfire/core/error.h>
#include <brushfire/io/read_mesh.h>
#include <brushfire/mesh/shapes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

namespace brushfire::corpus {
namespace {

namespace fs = std::filesystem;

Index sized(double full, double share, Index least = 3) { return std::max(least, static_cast<Index>(full * share)); }

// The side of a square grid of that many cells.
Index side(double cells, double share) { return std::max<Index>(4, static_cast<Index>(std::sqrt(cells * share))); }

Shape many_components(Index count, Dice& dice) {
  Shape s;
  const Shape part = shapes::icosphere(0);
  for (Index k = 0; k < count; ++k) {
    const auto offset = static_cast<Index>(s.positions.size());
    const Vec3 shift{static_cast<double>(k % 100), static_cast<double>(k / 100), dice.unit()};
    for (const Vec3& p : part.positions) s.positions.push_back(0.3 * p + shift);
    for (const Face& t : part.faces) s.faces.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return s;
}

Shape twice(Shape s, bool other_way_round) {
  const std::size_t count = s.faces.size();
  for (std::size_t f = 0; f < count; ++f) {
    const Face t = s.faces[f];
    s.faces.push_back(other_way_round ? Face{t[1], t[0], t[2]} : t);
  }
  return s;
}

// The twelve faces of a box, most of them many times.
Shape box_of_copies(Index faces, Dice& dice) {
  Shape s = shapes::cube(1);
  const std::size_t count = s.faces.size();
  while (s.faces.size() < faces) {
    const Face t = s.faces[dice.below(count)];
    s.faces.push_back(t);
  }
  return s;
}

Shape with(Shape s, void (*mutation)(Shape&, Dice&), Dice& dice) {
  mutation(s, dice);
  return s;
}

}  // namespace

std::vector<Subject> large_subjects(std::uint64_t seed, double share) {
  const auto dice = [seed](const char* name) { return Dice(name, seed, 0); };
  const auto terrain = [=](double cells, const char* name) {
    const Index n = side(cells, share);
    return shapes::noise_terrain(n, n, 0.3, Dice(name, seed, 1).below(1u << 30));
  };
  return {
      {"fan, closed", [=] { return oracle::fan(sized(1e6, share), true); }},
      {"fan, open, waves", [=] { return oracle::fan(sized(1e6, share), false, 0.3, 7); }},
      // From inside a face light crosses the rim at every edge, each time with another image of the source: the windows
      // are as many as the square of the rim's vertices, and no method that keeps them all is faster.
      {"bipyramid", [=] { return oracle::bipyramid(sized(1e3, share, 500), 1, 1); }},
      {"strip", [=] { return oracle::strip(sized(1e6, share), 1e-3); }},
      {"strip of needles", [=] { return oracle::strip(sized(1e6, share), 1e-7); }},
      {"1e5 components",
       [=] {
         Dice d = dice("components");
         return many_components(sized(1e5, share), d).mesh();
       }},
      {"book of 5e4 pages", [=] { return shapes::book(sized(5e4, share), 1, 2).mesh(); }},
      {"box of copies",
       [=] {
         Dice d = dice("box");
         return box_of_copies(sized(2e3, share, 100), d).mesh();
       }},
      {"prism, doubled", [] { return twice(shapes::cylinder(4, 24, 1, 5), true).mesh(); }},
      {"terrain, doubled", [=] { return twice(terrain(35e3, "doubled"), true).mesh(); }},
      {"terrain, tripled", [=] { return twice(twice(terrain(5e3, "tripled"), false), false).mesh(); }},
      {"terrain, sheared",
       [=] {
         Dice d = dice("sheared");
         return with(terrain(5e4, "sheared"), shear, d).mesh();
       }},
      {"terrain, stretched",
       [=] {
         Dice d = dice("stretched");
         return with(terrain(5e4, "stretched"), stretch, d).mesh();
       }},
      {"terrain, clusters",
       [=] {
         Dice d = dice("clusters");
         return with(terrain(5e4, "clusters"), pull_clusters, d).mesh();
       }},
      {"terrain, far point",
       [=] {
         Dice d = dice("far");
         return with(terrain(5e4, "far"), send_one_far, d).mesh();
       }},
      {"integer grid",
       [=] {
         const Index n = side(5e4, share);
         return shapes::plane(n, n, n, n).mesh();
       }},
      {"folded sphere", [=] { return shapes::folded_sphere(share < 0.5 ? 4 : 6, 6, 0.3, seed).mesh(); }},
      {"soup on a lattice",
       [=] {
         Dice d = dice("soup");
         return oracle::random_soup(d.below(1u << 30), sized(3e3, share, 40), sized(2e3, share, 40), 30);
       }},
  };
}

std::vector<Subject> file_subjects(const std::string& folder, std::uint64_t bytes) {
  static const std::set<std::string> endings{".off", ".ply", ".obj", ".stl"};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const bool fits = entry.is_regular_file() && entry.file_size() <= bytes;
    if (fits && endings.count(entry.path().extension().string())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Subject> subjects;
  for (const fs::path& file : files) {
    try {
      if (read_mesh(file.string()).mesh.face_count() == 0) continue;
    } catch (const Error&) {
      continue;  // polylines and point sets
    }
    subjects.push_back({file.filename().string(), [file] { return read_mesh(file.string()).mesh; }});
  }
  return subjects;
}

}  // namespace brushfire::corpus
