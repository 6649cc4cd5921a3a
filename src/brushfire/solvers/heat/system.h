// The two equations of the heat method on one mesh, factored once: heat that spreads for a short time, and the function
// whose gradient is nearest to the direction away from it.
//
// Based on: Crane, Weischedel, Wardetzky, "The heat method for distance computation", 2017.
#pragma once

#include <brushfire/solvers/heat/operators.h>
#include <brushfire/solvers/heat/relay.h>
#include <brushfire/solvers/heat/scales.h>
#include <brushfire/solvers/heat/triangulation.h>
#include <brushfire/solvers/heat_options.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace brushfire::heat {

// Heat put in at a vertex: weight * exp(-delay), in units that do not matter.
struct Spark {
  Index vertex = kNoIndex;
  double weight = 1;
  double delay = 0;  // >= 0
};
using Sparks = std::vector<Spark>;

// Throws Error(InvalidArgument) for options out of range.
void check(const HeatOptions& options);

class System {
 public:
  // Throws as check(), and Error(InvalidArgument) without Eigen. The factorization takes some 10 us a vertex on scans.
  System(const Mesh& mesh, const HeatOptions& options);

  const HeatOptions& options() const { return options_; }
  Index vertex_count() const { return static_cast<Index>(component_.size()); }
  // Of all the mesh, in mesh.unit(), squared and as it is.
  double time() const { return times_.all; }
  double mean_edge_length() const { return mean_edge_length_; }
  // Components of what heat can pass, kNoIndex for a vertex in no face.
  Index component(Index v) const { return component_[v]; }
  Index component_count() const { return component_count_; }
  double time_in(Index component) const { return times_.of[component]; }
  double mean_edge_in(Index component) const { return mean_edges_[component]; }
  // Whether all of a component lies at one place: there is nowhere to flow to.
  bool is_point(Index component) const { return is_point_[component]; }
  // False on a border that is kept cold.
  bool takes_heat(Index v) const { return options_.boundary != HeatBoundary::Dirichlet || !is_on_border(v); }

  // From heat at each of several sets of sparks, the function, up to a constant in each component, whose gradient is
  // nearest to the direction away from it: column j, entry v at [width * v + j]. In mesh.unit().
  std::vector<double> potentials(std::span<const Sparks> columns) const;

  // The heat of one set, however far it has to go.
  Heat diffuse(const Sparks& sparks) const;

 private:
  struct FlatFace {
    std::array<Index, 3> vertex;
    double length;
    Vec2 apex;
  };

  bool is_on_border(Index v) const { return !border_.empty() && border_[v]; }
  void find_border(const Mesh& mesh);
  std::vector<double> poisson_matrix() const;
  std::vector<double> heat_matrix(bool cold_border) const;
  std::vector<double> heat_by(std::size_t matrix, std::size_t width, std::span<const Sparks> columns) const;
  std::vector<double> heat_of(std::size_t width, std::span<const Sparks> columns) const;
  // The vertices that heat can come to.
  std::vector<std::uint8_t> lit_by(const Sparks& sparks) const;
  template <std::size_t kWidth>
  void add_divergence(std::span<const double> u, std::span<double> b) const;
  void add_divergence(const Heat& heat, std::size_t width, std::size_t column, std::span<double> b) const;

  HeatOptions options_;
  Times times_;
  double mean_edge_length_ = 0, per_sheet_ = 1;
  std::vector<double> mean_edges_;  // [components]
  std::vector<bool> is_point_;
  Index component_count_ = 0;
  std::vector<Index> component_;
  std::vector<std::uint8_t> border_;  // [vertex_count], where borders are kept cold
  Operators operators_;
  std::vector<FlatFace> faces_;
  std::vector<std::vector<double>> heat_;   // the heat matrices: one, or free and cold where both are averaged
  std::optional<Factors<double>> factors_;  // the Poisson matrix, and those
};

}  // namespace brushfire::heat
