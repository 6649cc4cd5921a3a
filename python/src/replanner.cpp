// _core.Replanner: costs that follow changes.
#include "interrupt.h"
#include "weighted.h"

#include <brushfire/solvers/weighted/replanner.h>

#include <new>

namespace brushfire::python {
namespace {

// Calls from several threads wait for each other.
class Planner {
  template <class Get>
  auto read(Get&& get) {
    const nb::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    return get();
  }

 public:
  Planner(Weighted& weighted, const Sources& sources, double tolerance, bool towards, nb::object progress) {
    ReplannerOptions options;
    options.tolerance = tolerance;
    options.towards = towards;
    options.progress = [this](double share) {
      if (progress_) progress_(share);
    };
    compute(std::move(progress), [&] {
      const auto [domain, weights] =
          weighted.with([](const WeightedSolver& s) { return std::pair(s.domain(), s.weights()); });
      planner_.emplace(domain, weights, sources.list, options);
    });
  }

  void change(Weighted& weighted, nb::object progress) {
    compute(std::move(progress),
            [&] { planner_->change(weighted.with([](const WeightedSolver& s) { return s.weights(); })); });
  }
  void move(const Sources& sources, nb::object progress) {
    compute(std::move(progress), [&] { planner_->move(sources.list); });
  }

  double renewed() {
    return read([&] { return planner_->renewed(); });
  }
  auto distance() {
    return to_numpy(read([&] { return planner_->field().distance; }));
  }
  auto source() {
    return to_numpy_signed(read([&] { return planner_->field().source; }));
  }

  nb::tuple paths(const Vector<std::int64_t>& index, const std::optional<Triples<double>>& weights) {
    const std::vector<WeightedPath> found = listening(false, [&] {
      const std::lock_guard lock(mutex_);
      return weighted_paths(planner_->field(), targets_from(planner_->domain().mesh(), {index, weights}));
    });
    return paths_to_numpy(found, path_arrays);
  }

 private:
  template <class Use>
  void compute(nb::object progress, Use&& use) {
    Computation computation(std::move(progress));
    computation.run(false, [&] {
      const std::lock_guard lock(mutex_);
      progress_ = computation.progress();
      use();
      progress_ = {};
      return true;
    });
  }

  std::mutex mutex_;
  Progress progress_;  // of the call that is under way
  std::optional<Replanner> planner_;
};

}  // namespace

void bind_replanner(nb::module_& m) {
  nb::class_<Planner>(m, "Replanner")
      .def(nb::init<Weighted&, const Sources&, double, bool, nb::object>(), nb::arg("weighted"), nb::arg("sources"),
           nb::arg("tolerance"), nb::arg("towards"), nb::arg("progress").none())
      .def("change", &Planner::change, nb::arg("weighted"), nb::arg("progress").none())
      .def("move", &Planner::move, nb::arg("sources"), nb::arg("progress").none())
      .def("paths", &Planner::paths, nb::arg("target_index").noconvert(), nb::arg("target_weights").noconvert().none())
      .def("distance", &Planner::distance)
      .def("source", &Planner::source)
      .def_prop_ro("renewed", &Planner::renewed);
}

}  // namespace brushfire::python
