// Times the kernels with Google Benchmark: nanoseconds a run, items a second. Its own options apply
// (--benchmark_filter=march --benchmark_repetitions=9 ...).
#include <benchmark/benchmark.h>

#include "kernels.h"

int main(int count, char** arguments) {
  for (const brushfire::benchmark::Kernel& kernel : brushfire::benchmark::kernels()) {
    const auto time = [kernel](benchmark::State& state) {
      const brushfire::benchmark::Run run = kernel.prepare();
      for ([[maybe_unused]] const auto step : state) benchmark::DoNotOptimize(run());
      state.SetItemsProcessed(static_cast<std::int64_t>(kernel.items) * state.iterations());
    };
    benchmark::RegisterBenchmark(kernel.name.c_str(), time)->Unit(benchmark::kMicrosecond);
  }
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
