// Random windows over random triangles, and lists of them.
#pragma once

#include <brushfire/solvers/windows/algebra/frame.h>
#include <brushfire/solvers/windows/algebra/window.h>
#include <brushfire/solvers/windows/store/exact_lists.h>

#include <algorithm>
#include <random>
#include <vector>

namespace brushfire::windows {

inline constexpr int kLists = 4000;

struct RandomLists : std::mt19937 {
  using std::mt19937::mt19937;
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(*this); }

  Frame frame() {
    const double length = uniform(0.5, 2);
    const Vec2 apex{uniform(-0.5, 1.5) * length, uniform(0.1, 1.5) * length};
    return {length, length_of(apex.x, apex.y), length_of(length - apex.x, apex.y), apex};
  }
  Window window(double length) {
    Window w;
    w.sigma = uniform(0, 1) < 0.5 ? 0 : uniform(0, 3);
    w.source = {uniform(-2, 3) * length, -uniform(0.05, 6) * length};
    w.b0 = uniform(0, 1) < 0.3 ? 0 : uniform(0, 0.9) * length;
    w.b1 = uniform(0, 1) < 0.3 ? length : uniform(w.b0, length);
    w.d0 = value_at(w, w.b0);
    w.d1 = value_at(w, w.b1);
    w.pseudo_source = static_cast<Index>((*this)() % 1000);
    return w;
  }
  // Sorted by where they begin.
  std::vector<Window> windows(double length) {
    std::vector<Window> result((*this)() % 20 + 1);
    for (Window& w : result) w = window(length);
    std::sort(result.begin(), result.end(), [](const Window& a, const Window& b) { return a.b0 < b.b0; });
    return result;
  }
};

inline WindowList list_of(const std::vector<Window>& windows, BlockPool& pool) {
  WindowList list;
  list.block = pool.allocate(static_cast<Index>(windows.size()));
  for (const Window& w : windows) list.block.columns().set(list.size++, w);
  return list;
}

inline std::vector<Window> windows_of(const WindowColumns& columns, Index count) {
  std::vector<Window> result;
  for (Index i = 0; i < count; ++i) result.push_back(columns.window(i));
  return result;
}

}  // namespace brushfire::windows
