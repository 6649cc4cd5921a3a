// Windows and frames at random, of every shape that a run meets.
#pragma once

#include <brushfire/solvers/windows/algebra/window.h>

#include <cmath>
#include <random>

namespace brushfire::windows {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
  double log_uniform(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }

  // Any triangle: also obtuse at either end of the base.
  Frame frame() {
    const double length = log_uniform(0.1, 10);
    const Vec2 apex{uniform(-1, 2) * length, log_uniform(0.01, 3) * length};
    return {length, length_of(apex.x, apex.y), length_of(length - apex.x, apex.y), apex};
  }

  Window window(double length) {
    Window w;
    w.sigma = below(2) ? 0 : uniform(0, 10);
    if (below(4) == 0) {
      w.kind = WindowKind::Linear;
      const double angle = uniform(0.05, kPi - 0.05);
      w.source = {std::cos(angle), -std::sin(angle)};
      w.sigma += length;
    } else {
      w.source = {uniform(-3, 4) * length, -log_uniform(0.01, 10) * length};
    }
    w.b0 = below(3) ? uniform(0, 0.9) * length : 0;
    w.b1 = below(3) ? uniform(w.b0, length) : length;
    w.d0 = value_at(w, w.b0);
    w.d1 = value_at(w, w.b1);
    w.pseudo_source = static_cast<Index>(below(1000));
    return w;
  }

  // Two windows over the whole edge with their sources side by side, as around a vertex of positive curvature.
  std::vector<Window> neighbours(double length) {
    std::vector<Window> pair(2, window(length));
    pair[1].source.x += uniform(-0.3, 0.3) * length;
    pair[1].source.y *= uniform(0.8, 1.2);
    pair[1].sigma += uniform(-0.1, 0.1) * length;
    for (Window& w : pair) {
      w.kind = WindowKind::Circular;
      w.b0 = 0;
      w.b1 = length;
      w.d0 = value_at(w, 0);
      w.d1 = value_at(w, length);
      w.slack = uniform(0, 1e-3);
    }
    return pair;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace brushfire::windows
