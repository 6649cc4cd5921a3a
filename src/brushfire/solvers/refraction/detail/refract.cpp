// The flattest circular front below a refracted one, in closed form, and what it loses at most.
#include <brushfire/solvers/refraction/detail/refract.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brushfire::refraction {
namespace {

using windows::length_of;
using windows::WindowKind;

// A window that would lose too much is halved this many times at most: one of third order in its length is then lost
// 30,000 times less.
constexpr int kHalvings = 12;
// What a piece may always lose, as a share of what a path of its length earns: its light goes about as far until it
// refracts again, so that slack stays a share of the path even where none is left. A share of the whole path instead
// would let light that winds round a vertex become cheaper with every turn.
constexpr double kEarned = 0.5;
// What rounding makes of values anyway, as a share of them.
constexpr double kStraight = 4 * std::numeric_limits<double>::epsilon();
// As far as this many values, sources are known to epsilons that are no more than the sums of a path are off by anyway.
constexpr double kFar = 1e5;

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

// How far below `front` the window is, at most. Between two places the difference is above its chord by no more than
// its least second derivative makes it. It is also no more than the front less the two lines that meet at the foot of
// the window's source, which is convex on either side of that; the window is over these lines most at the place that is
// nearest to the foot.
double loss_of(const Front& front, const Front& below, const Piece& p) {
  constexpr int kSteps = 4;
  const double foot = below.source.x, step = (p.x1 - p.x0) / kSteps;
  double loss = p.x0 < foot && foot < p.x1 ? std::max(0.0, front.value(foot) - below.value(foot)) : 0, before = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const double a = p.x0 + (i - 1) * step, b = i == kSteps ? p.x1 : p.x0 + i * step, near = std::clamp(foot, a, b);
    const double here = i == kSteps ? 0 : front.value(b) - below.value(b);
    const double over_lines = below.radius(near) - std::abs(near - foot);
    const double arch = std::max(0.0, below.most_bend(a, b) - front.least_bend(a, b)) * step * step / 8;
    loss = std::max(loss, std::max(before, here) + std::min(arch, over_lines));
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
    const double least = front.value(std::clamp(front.source.x, p.x0, p.x1));
    sigma = std::min(cap, std::max(nu * front.sigma + (1 - nu) * most, least * (1 - farthest_source(n))));
  }
  const double r0 = p.f0 - sigma, r1 = p.f1 - sigma, apart = sigma < cap ? (r0 + r1 - length) * (r0 + r1 + length) : 0;
  if (!(apart > 0)) return {{p.x0 + (p.f0 - cap), 0}, cap, 1};
  // r1 - r0 is the rise; of far sources it would lose all its digits.
  return {{p.x0 + 0.5 * (length - rise * (r0 + r1) / length), -0.5 * std::sqrt(apart * steep) / length}, sigma, 1};
}

// Seen from far away, or along the edge, a front is straight to rounding, and its light parallel.
bool is_straight(const Front& front, const Piece& p) {
  const double length = p.x1 - p.x0;
  return front.most_bend(p.x0, p.x1) * length * length / 8 <= kStraight * std::min(p.f0, p.f1);
}

Window straight(Window w, const Piece& p, double slack) {
  const double slope = (p.f1 - p.f0) / (p.x1 - p.x0);
  w.kind = WindowKind::Linear;
  w.b0 = p.x0, w.b1 = p.x1;
  w.d0 = p.f0, w.d1 = p.f1;
  w.source = {-slope, -std::sqrt((1 - slope) * (1 + slope))};
  w.sigma = p.f0 - slope * p.x0;
  w.slack = slack;
  return w;
}

void refract_piece(const Window& w, const Front& front, const Piece& p, const RefractionBudget& budget, int halvings,
                   std::vector<Window>& out) {
  const double length = p.x1 - p.x0;
  if (!(length > std::abs(p.f1 - p.f0))) return;  // grazes the edge: its light runs along it
  if (is_straight(front, p)) return out.push_back(straight(w, p, front.speed * w.slack));
  const Front found = below(front, p);
  Window g = w;
  g.b0 = p.x0, g.b1 = p.x1;
  g.d0 = p.f0, g.d1 = p.f1;
  g.source = found.source;
  g.sigma = found.sigma;
  const double loss = loss_of(front, found, p), slack = front.speed * w.slack;
  const double all = budget.share * (minimum_of(g) - budget.start);
  const double allowed = std::max(budget.pace * (all - slack), kEarned * budget.share * length);
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

double farthest_source(double n) { return std::max(kFar, 4 / (n * n)); }

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
