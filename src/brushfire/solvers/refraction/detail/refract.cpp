// The flattest circular front below a refracted one, in closed form, and what it loses at most.
#include <brushfire/solvers/refraction/detail/refract.h>

#include <brushfire/core/detail/planar.h>

#include <algorithm>
#include <cmath>

namespace brushfire::refraction {
namespace {

using windows::length_of;
using windows::WindowKind;

// A window that would lose too much is halved this many times at most: one of third order in its length is then lost
// 30,000 times less.
constexpr int kHalvings = 12;
// What is not worth halving a window for, as a share of all that may be spent.
constexpr double kLittle = 1e-2;

// A point source below the edge whose light costs `speed` for a unit of length.
struct Front {
  Vec2 source;
  double sigma = 0, speed = 1;

  double radius(double x) const { return length_of(x - source.x, source.y); }
  double value(double x) const { return sigma + speed * radius(x); }
  // The least and the greatest second derivative on [a, b].
  double least_bend(double a, double b) const { return bend(std::max(radius(a), radius(b))); }
  double most_bend(double a, double b) const { return bend(radius(std::clamp(source.x, a, b))); }
  double bend(double radius) const {
    return radius > 0 ? speed * (source.y / radius) * (source.y / radius) / radius : 0;
  }
};

struct Piece {
  double x0, x1, f0, f1;
};

// How far below `front` the window is, at most. Both are smooth: between two places the difference is above its chord
// by no more than its least second derivative makes it.
double loss_of(const Front& front, const Front& below, const Piece& p) {
  if (below.source.y == 0) return std::max(0.0, front.value(below.source.x) - below.sigma);  // convex on both sides
  constexpr int kSteps = 4;
  const double step = (p.x1 - p.x0) / kSteps;
  double loss = 0, before = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const double a = p.x0 + (i - 1) * step, b = i == kSteps ? p.x1 : p.x0 + i * step;
    const double here = i == kSteps ? 0 : front.value(b) - below.value(b);
    const double arch = std::max(0.0, below.most_bend(a, b) - front.least_bend(a, b)) * step * step / 8;
    loss = std::max(loss, std::max(before, here) + arch);
    before = here;
  }
  return loss;
}

// The window through the piece's ends that is nowhere above the front and as near to it as that allows.
Front below(const Front& front, const Piece& p) {
  const double length = p.x1 - p.x0, rise = p.f1 - p.f0, n = front.speed;
  const double wide = (n * length - rise) * (n * length + rise), steep = (length - rise) * (length + rise);
  const double cap = 0.5 * (p.f0 + p.f1 - length);  // its source is on the edge; nothing that refracts is below
  double sigma = cap;
  if (wide > 0) {
    const double nu = steep / wide;
    double most;  // of the mean of front and chord where nu < 1, its least elsewhere
    if (nu < 1) {
      most = std::max(p.f0, p.f1);
    } else {
      const double slope = rise / (n * length);
      const double x =
          std::clamp(front.source.x + front.source.y * slope / std::sqrt((1 - slope) * (1 + slope)), p.x0, p.x1);
      most = 0.5 * (p.f0 + rise * ((x - p.x0) / length) + front.value(x));
    }
    sigma = std::min(cap, nu * front.sigma + (1 - nu) * most);
  }
  const double r0 = p.f0 - sigma, r1 = p.f1 - sigma, q = sigma < cap ? heron(length, r0, r1) : 0;
  if (!(q > 0)) return {{p.x0 + (p.f0 - cap), 0}, cap, 1};
  return {{p.x0 + 0.5 * (length + (r0 - r1) * (r0 + r1) / length), -0.5 * std::sqrt(q) / length}, sigma, 1};
}

void refract_piece(const Window& w, const Front& front, const Piece& p, const RefractionBudget& budget, int halvings,
                   std::vector<Window>& out) {
  const double length = p.x1 - p.x0;
  if (!(length > std::abs(p.f1 - p.f0))) return;  // grazes the edge: its light runs along it
  const Front found = below(front, p);
  Window g = w;
  g.b0 = p.x0, g.b1 = p.x1;
  g.d0 = p.f0, g.d1 = p.f1;
  g.source = found.source;
  g.sigma = found.sigma;
  const double loss = loss_of(front, found, p), slack = front.speed * w.slack;
  const double all = budget.share * (minimum_of(g) - budget.start);
  const double allowed = std::max(budget.pace * (all - slack), kLittle * all);
  const double middle = 0.5 * (p.x0 + p.x1);
  if (loss > allowed && halvings > 0 && middle > p.x0 && middle < p.x1) {
    const double f = front.value(middle);
    refract_piece(w, front, {p.x0, middle, p.f0, f}, budget, halvings - 1, out);
    refract_piece(w, front, {middle, p.x1, f, p.f1}, budget, halvings - 1, out);
    return;
  }
  g.slack = slack + loss;
  if (windows::is_visible(g)) out.push_back(g);
}

// All directions are one: so they are behind the edge.
void refract_parallel(const Window& w, double n, std::vector<Window>& out) {
  const double across = n * w.source.x, steep = (1 - across) * (1 + across);
  if (!(steep > 0)) return;
  Window g = w;
  g.source = {across, -std::sqrt(steep)};
  g.sigma *= n, g.d0 *= n, g.d1 *= n, g.slack *= n;
  out.push_back(g);
}

// From a point of the edge light goes everywhere.
void refract_on_edge(const Window& w, double n, std::vector<Window>& out) {
  Window g = w;
  g.source.y = 0;
  g.sigma *= n, g.slack *= n;
  g.d0 = value_at(g, g.b0), g.d1 = value_at(g, g.b1);
  if (windows::is_visible(g)) out.push_back(g);
}

}  // namespace

void refract(const Window& w, double n, const RefractionBudget& budget, std::vector<Window>& out) {
  if (w.kind == WindowKind::Linear) return refract_parallel(w, n, out);
  if (w.source.y == 0) return refract_on_edge(w, n, out);
  const Front front{w.source, n * w.sigma, n};
  Piece p{w.b0, w.b1, n * w.d0, n * w.d1};
  if (n > 1) {  // beyond the critical angle all is reflected
    const double reach = -w.source.y / std::sqrt((n - 1) * (n + 1));
    if (w.source.x - reach > p.x0) p.x0 = w.source.x - reach, p.f0 = front.value(p.x0);
    if (w.source.x + reach < p.x1) p.x1 = w.source.x + reach, p.f1 = front.value(p.x1);
  }
  if (p.x0 < p.x1) refract_piece(w, front, p, budget, kHalvings, out);
}

}  // namespace brushfire::refraction
