// Pictures of meshes and of what was computed on them, without a display, a window system or a GPU.
#pragma once

#include <brushfire/figure/camera.h>
#include <brushfire/figure/colormap.h>
#include <brushfire/figure/image.h>
#include <brushfire/mesh/mesh.h>
#include <brushfire/mesh/shared_face.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brushfire {

// A curve on (or near) the surface, drawn as a tube of constant width on the screen.
struct Polyline {
  std::vector<Vec3> points;
  bool closed = false;
};

// One mesh and what is shown on it. All that is empty is not shown.
struct Panel {
  Mesh mesh;                              // with positions
  std::vector<double> scalar;             // [vertex_count]; faces with a value that is not finite are grey
  std::size_t scale = 0;                  // which of RenderOptions::scales colours it
  std::vector<Index> labels;              // [vertex_count]; coloured by label instead of by scalar; kNoIndex is grey
  std::vector<std::string> label_names;   // for the legend; by number where there are none
  std::vector<SharedFace> label_borders;  // ascending by face; elsewhere the nearest corner gives the label
  std::vector<Index> label_colors;        // of label i, a number for label_color(); empty: i
  double front = kInfinity;      // where `scalar` is greater, the surface is plain: what a fire has not reached yet
  std::vector<double> isolines;  // levels of `scalar`, ascending; drawn as lines of constant screen width
  std::vector<Polyline> paths;
  std::vector<Vec3> dots;  // sources
  // How open each corner is on the front and on the back of its face, [halfedge_count], as ambient_occlusion() makes
  // it: crevices are shaded darker.
  std::vector<std::array<float, 2>> openness;
  std::string title;
};

enum class Fill : std::uint8_t {
  Smooth,  // the colour map, continuously
  Bands,   // alternating darker and lighter bands between consecutive isolines (figure 8 of Novotni & Klein 2002)
};

// How values become colours, and the colour bar that says so. Values beyond a given range have the colour of its end:
// the bar then has a point there, and says how far they go.
struct ColorScale {
  Colormap colormap = Colormap::Viridis;
  std::optional<double> low, high;  // the range; from the finite scalars of all panels with this scale otherwise
  std::string unit;                 // written above the bar
};

struct RenderOptions {
  int width = 1024, height = 768;  // of each panel, pixels; 16 to 16384
  Camera camera;
  std::vector<ColorScale> scales = std::vector<ColorScale>(1);  // Panel::scale counts them
  Fill fill = Fill::Smooth;
  bool colour_bar = true;  // shown where a panel has a scalar, or labels
  bool wireframe = false;
  bool silhouettes = true;   // dark lines where the surface ends or steps back
  bool transparent = false;  // background; otherwise white
  double line_width = 1.6;   // of isolines, pixels
  double path_width = 6.5;   // pixels, its white seam included
  bool hidden_paths = true;  // dashed where the surface hides them; false: left out there
  double dot_size = 13;      // pixels
  int samples = 3;           // per pixel and direction, 1 to 8
  unsigned threads = 0;      // 0: one per processor; the pixels are the same for any number
  std::string font;          // a TrueType file; empty: the built-in part of DejaVu Sans (Latin, Greek, Cyrillic)
};

// The panels side by side in one picture. Those of one scale share a range of colours and a colour bar, which stands
// after the last of them: (paper, exact, error) with scales 0, 0, 1 has the bar of the distances after the second panel
// and the bar of the error after the third. The same input gives the same pixels. Throws Error(InvalidArgument) for
// sizes that do not match the mesh or lie out of range, a scale that is not there, a mesh without positions, and a font
// that cannot be read. No font of the system is looked for.
// O(faces + pixels) time; 36 bytes a sample for a strip of the picture, not the whole.
Image render(std::span<const Panel> panels, const RenderOptions& options = {});

// The same as SVG: the shaded surfaces as an embedded PNG; isolines (given as Panel::paths of `lines`, one entry per
// panel), paths, dots, text and colour bar as vectors, hidden parts left out.
std::string render_svg(std::span<const Panel> panels, std::span<const std::vector<Polyline>> lines,
                       const RenderOptions& options = {});

}  // namespace brushfire
