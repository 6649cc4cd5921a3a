// brushfire smooth: values smoothed along the surface.
#include "computing.h"
#include "fields.h"
#include "interrupt.h"
#include "output.h"
#include "surface.h"

#include <brushfire/queries/smoothing.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  brushfire smooth cortex.gii thickness.func.gii --fwhm 6 --mask cortex.label -o smooth.func.gii
  brushfire smooth part.stl heat.npy --sigma 0.5 -o smooth.npy

Every value becomes the mean of those around it, weighted by a Gaussian of the distance along the surface and by area:
--sigma is its standard deviation, --fwhm its full width at half maximum (2.355 sigma); it ends at 4 sigma. Nothing is
carried through walls or out of a mask. Values that are not finite do not count, and stay as they are.)";

struct Arguments {
  std::string file, field, output;
  SharedArguments shared;
  std::optional<double> sigma, fwhm;
};

int smooth_verb(const Arguments& a, const Talk& talk) {
  if (a.output.empty()) refuse("where to? give -o FILE");
  check_output(a.output);
  if (a.sigma.has_value() == a.fwhm.has_value()) refuse("how wide? give one of --sigma and --fwhm");
  if (a.output == "-" && talk.json) refuse("only one of -o - and --json can have the standard output");
  const double sigma = a.sigma ? *a.sigma : *a.fwhm / kFwhmPerSigma;
  MatrixOptions options;
  options.distance = computation(a.shared);
  options.threads = std::exchange(options.distance.threads, 1);
  const Surface surface(a.file, a.shared);
  stop_if_interrupted();
  const LoadedField loaded = read_field(a.field, a.shared.array_name);
  std::vector<double> values =
      surface.on_mesh(values_of(loaded, a.field, surface.file().mesh.vertex_count(), "the mesh"), a.field);
  const std::vector<double> before = values;
  for (double& v : values) v = std::isfinite(v) ? v : std::nan("");
  options.distance.progress = talk.progress("smooth");
  const SparseMatrix<double> kernel = smoothing_kernel(surface.domain(), sigma, options);
  std::vector<double> smooth = smoothed(kernel, values);
  talk.end_progress();
  for (std::size_t v = 0; v < smooth.size(); ++v) {
    if (!std::isfinite(before[v])) smooth[v] = before[v];
    if (!surface.domain().is_open(static_cast<Index>(v))) smooth[v] = kInfinity;
  }
  write_values(surface, a.output,
               {.values = surface.on_file<double>(smooth), .name = loaded.name.empty() ? "smooth" : loaded.name});
  const double entries = static_cast<double>(kernel.value.size()) / std::max<double>(1, surface.mesh().vertex_count());
  if (talk.json) {
    Record record;
    record.add("file", a.file).add("sigma", sigma).add("fwhm", sigma * kFwhmPerSigma).add("unit", unit_of(a.shared));
    write_stdout(record.add("neighbours", entries).add("output", a.output).json());
  } else {
    talk.say("each value is a mean over " + readable(entries) + " vertices");
  }
  return kOk;
}

}  // namespace

void add_smooth(CommandLine& command_line) {
  const auto a = std::make_shared<Arguments>();
  command_line.add("smooth", "Values smoothed along the surface", [&](Verb& verb) {
    add_surface(verb, a->file);
    verb.argument("FIELD", a->field, "The values, one per vertex");
    verb.option("--sigma", a->sigma, "S", kPositive, "Standard deviation of the Gaussian");
    verb.option("--fwhm", a->fwhm, "W", kPositive, "Its full width at half maximum, instead");
    verb.option("-o,--output", a->output, "FILE",
                ("Write the values: " + extensions_of(fields_written()) + "; - prints CSV").c_str());
    verb.talks();
    add_shared(verb, a->shared,
               {.without = {{kWeights, "kernels fall off with the length of the way"},
                            {kStarting, "every vertex has a kernel of its own"},
                            {{Shared::Radius}, "the kernel ends at 4 sigma"},
                            {{Shared::Scalar}, "the values to smooth are FIELD"}}});
    verb.examples(kExamples);
    verb.run([a](Talk& talk) { return smooth_verb(*a, talk); });
  });
}

}  // namespace brushfire::tool
