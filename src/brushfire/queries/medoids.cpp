// Partitioning around medoids on a given matrix.
#include <brushfire/core/cancel.h>
#include <brushfire/core/error.h>
#include <brushfire/queries/centroidal.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace brushfire {
namespace {

class Partition {
 public:
  Partition(std::span<const double> distances, std::size_t n, std::span<const double> weights)
      : distances_(distances), n_(n), weights_(weights), first_(n), second_(n) {
    double greatest = 0;
    for (const double d : distances) {
      if (std::isnan(d)) throw Error(ErrorCode::InvalidArgument, "a distance is NaN");
      if (d < kInfinity) greatest = std::max(greatest, d);
    }
    // More than all finite ones together, and still a number that can be subtracted.
    unreachable_ = (greatest > 0 ? greatest : 1) * static_cast<double>(n + 1) * 2;
    for (auto& f : first_) f.first = unreachable_ * 2;
    for (auto& s : second_) s.first = unreachable_ * 2;
  }

  // Greedy: again and again the place that saves most.
  void build(Index count) {
    while (medoids_.size() < count) {
      stop_if_cancelled();
      double best = kInfinity;
      Index choice = kNoIndex;
      for (Index h = 0; h < n_; ++h) {
        if (is_medoid(h)) continue;
        double change = 0;
        for (Index j = 0; j < n_; ++j) change += weight(j) * std::min(0.0, distance(h, j) - first_[j].first);
        if (choice == kNoIndex || change < best) {
          best = change;
          choice = h;
        }
      }
      medoids_.push_back(choice);
      assign();
    }
  }

  // One exchange that pays most; false where none does.
  bool exchange() {
    stop_if_cancelled();
    double best = -kPays * cost();
    std::pair<Index, std::size_t> choice{kNoIndex, 0};
    std::vector<double> loss(medoids_.size());
    for (Index h = 0; h < n_; ++h) {
      if (is_medoid(h)) continue;
      std::fill(loss.begin(), loss.end(), 0.0);
      double gain = 0;
      for (Index j = 0; j < n_; ++j) {
        const double d = distance(h, j), own = first_[j].first;
        const double closer = std::min(0.0, d - own);
        gain += weight(j) * closer;
        // Without its own medoid j goes to the newcomer or to its second.
        loss[first_[j].second] += weight(j) * (std::min(d, second_[j].first) - own - closer);
      }
      for (std::size_t i = 0; i < loss.size(); ++i) {
        if (gain + loss[i] < best) {
          best = gain + loss[i];
          choice = {h, i};
        }
      }
    }
    if (choice.first == kNoIndex) return false;
    medoids_[choice.second] = choice.first;
    assign();
    return true;
  }

  Medoids result() const {
    Medoids m{medoids_, {}, 0};
    for (Index j = 0; j < n_; ++j) {
      m.nearest.push_back(first_[j].second);
      if (weight(j) > 0) m.cost += weight(j) * distances_[medoids_[first_[j].second] * n_ + j];
    }
    return m;
  }

 private:
  // What an exchange has to save at least: rounding must not exchange for ever.
  static constexpr double kPays = 1e-12;

  double distance(std::size_t i, std::size_t j) const {
    const double d = distances_[i * n_ + j];
    return d < kInfinity ? d : unreachable_;
  }
  double weight(std::size_t j) const { return weights_.empty() ? 1 : weights_[j]; }
  bool is_medoid(Index h) const { return std::find(medoids_.begin(), medoids_.end(), h) != medoids_.end(); }

  double cost() const {
    double sum = 0;
    for (Index j = 0; j < n_; ++j) sum += weight(j) * first_[j].first;
    return sum;
  }

  void assign() {
    for (Index j = 0; j < n_; ++j) {
      first_[j] = second_[j] = {2 * unreachable_, kNoIndex};
      for (Index i = 0; i < medoids_.size(); ++i) {
        const std::pair entry{distance(medoids_[i], j), i};
        if (entry < first_[j]) {
          second_[j] = std::exchange(first_[j], entry);
        } else if (entry < second_[j]) {
          second_[j] = entry;
        }
      }
    }
  }

  std::span<const double> distances_;
  std::size_t n_;
  std::span<const double> weights_;
  double unreachable_ = 0;
  std::vector<Index> medoids_;
  std::vector<std::pair<double, Index>> first_, second_;  // of each place: distance, position in medoids_
};

}  // namespace

Medoids k_medoids(std::span<const double> distances, Index count, std::span<const double> weights) {
  const auto n = static_cast<std::size_t>(std::llround(std::sqrt(static_cast<double>(distances.size()))));
  if (n * n != distances.size()) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(distances.size()) + " distances are no square matrix");
  }
  if (count == 0 || count > n) {
    throw Error(ErrorCode::InvalidArgument, std::to_string(count) + " medoids of " + std::to_string(n) + " places");
  }
  if (!weights.empty() && weights.size() != n) {
    throw Error(ErrorCode::InvalidArgument,
                std::to_string(weights.size()) + " weights for " + std::to_string(n) + " places");
  }
  for (const double w : weights) {
    if (!(w >= 0) || !std::isfinite(w)) throw Error(ErrorCode::InvalidArgument, "a weight is not finite and >= 0");
  }
  Partition partition(distances, n, weights);
  partition.build(count);
  while (partition.exchange()) {
  }
  return partition.result();
}

}  // namespace brushfire
