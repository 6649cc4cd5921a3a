// Functions of slope, sampled.
#include <brushfire/solvers/steiner/slope_pace.h>

#include <brushfire/core/detail/text.h>
#include <brushfire/core/error.h>

#include <algorithm>
#include <cmath>

namespace brushfire {
namespace {

// Small enough that Tobler's function, linear between samples, is right to 1e-7; its corner at -0.05 is a sample.
constexpr double kStep = 2.5e-4;

}  // namespace

SlopePace::SlopePace(double first, double last, const std::function<double(double)>& pace) {
  const auto steps = static_cast<std::size_t>(std::max(1.0, std::round((last - first) / kStep)));
  first_ = first;
  per_slope_ = static_cast<double>(steps) / (last - first);
  last_place_ = static_cast<double>(steps);
  for (std::size_t i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(steps);
    pace_.push_back(pace((1 - share) * first + share * last));
  }
}

SlopePace SlopePace::tobler() {
  return {-2, 2, [](double s) { return 3.6 / (6 * std::exp(-3.5 * std::abs(s + 0.05))); }};
}

SlopePace SlopePace::naismith() {
  const double gentle = std::tan(5 * kPi / 180), steep = std::tan(12 * kPi / 180);
  return {-2, 2, [=](double s) {
            const double flat = 0.72;  // 5 km/h
            return flat + (s > 0 ? 6 * s : -s >= steep ? -2 * s : -s >= gentle ? 2 * s : 0);
          }};
}

SlopePace SlopePace::energy() {
  return {-0.5, 0.5, [](double i) {
            // Of a metre along the slope, of which a metre on the map has more.
            const double along = ((((280.5 * i - 58.7) * i - 76.8) * i + 51.9) * i + 19.6) * i + 2.5;
            return along * std::sqrt(1 + i * i);
          }};
}

SlopePace SlopePace::table(std::span<const double> slopes, std::span<const double> paces) {
  const bool ascend =
      std::adjacent_find(slopes.begin(), slopes.end(), [](double a, double b) { return !(a < b); }) == slopes.end();
  if (slopes.size() < 2 || slopes.size() != paces.size() || !ascend || !std::isfinite(slopes.front()) ||
      !std::isfinite(slopes.back())) {
    throw Error(ErrorCode::InvalidArgument,
                "a table of paces has two slopes at least, which ascend, and a pace for each");
  }
  for (const double p : paces) {
    if (p > 0 && p < kInfinity) continue;
    throw Error(ErrorCode::InvalidArgument, "pace " + number_as_text(p) + " is not > 0 and finite");
  }
  return {slopes.front(), slopes.back(), [&](double s) {
            const auto above = std::clamp<std::size_t>(
                static_cast<std::size_t>(std::upper_bound(slopes.begin(), slopes.end(), s) - slopes.begin()), 1,
                slopes.size() - 1);
            const double t = (s - slopes[above - 1]) / (slopes[above] - slopes[above - 1]);
            return (1 - t) * paces[above - 1] + t * paces[above];
          }};
}

SlopePace SlopePace::up_to(double steepest) const {
  const double last = first_ + last_place_ / per_slope_;
  const double low = std::max(first_, -steepest), high = std::min(last, steepest);
  if (!(low < high)) {
    throw Error(ErrorCode::InvalidArgument, "steepest slope " + number_as_text(steepest) + ": no slope is left");
  }
  return {low, high, [&](double s) { return (*this)(std::clamp(s, first_, last)); }};
}

SlopePace SlopePace::function(double first, double last, const std::function<double(double)>& pace) {
  if (!(first < last && std::isfinite(first) && std::isfinite(last))) {
    throw Error(ErrorCode::InvalidArgument, "slopes from " + number_as_text(first) + " to " + number_as_text(last) +
                                                ": the first must be below the last, both finite");
  }
  return {first, last, [&](double s) {
            const double p = pace(s);
            if (p > 0 && p < kInfinity) return p;
            throw Error(ErrorCode::InvalidArgument,
                        "pace " + number_as_text(p) + " at slope " + number_as_text(s) + " is not > 0 and finite");
          }};
}

SlopePace SlopePace::tacking() const {
  SlopePace tacks = *this;
  const auto count = static_cast<std::ptrdiff_t>(pace_.size());
  // From slope 0 on, one way and the other: what a unit of height costs at the best of the gentler slopes.
  const auto spread = [&](std::ptrdiff_t step, double& height) {
    for (std::ptrdiff_t i = step > 0 ? 0 : count - 1; i >= 0 && i < count; i += step) {
      const double slope = std::abs(first_ + static_cast<double>(i) / per_slope_);
      const bool is_this_way = (first_ + static_cast<double>(i) / per_slope_) * static_cast<double>(step) > 0;
      if (!is_this_way) continue;
      double& pace = tacks.pace_[static_cast<std::size_t>(i)];
      height = std::min(height, pace / slope);
      pace = std::min(pace, slope * height);
    }
  };
  spread(1, tacks.climb_ = kInfinity);
  spread(-1, tacks.descent_ = kInfinity);
  return tacks;
}

double SlopePace::least() const { return *std::min_element(pace_.begin(), pace_.end()); }

}  // namespace brushfire
