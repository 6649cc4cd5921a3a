// Weighted distances by a graph of many equal steps on every edge: simple, slow, and built from positions alone. What
// it finds are costs of real paths, so no proven lower bound may be above it.
#pragma once

#include <brushfire/mesh/mesh.h>
#include <brushfire/solvers/steiner/weights.h>

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <utility>
#include <vector>

namespace brushfire::testing_support {

class DenseGraph {
 public:
  DenseGraph(const Mesh& mesh, const Weights& weights, Index steps) : mesh_(mesh), steps_(steps) {
    for (Index f = 0; f < mesh.face_count(); ++f) {
      faces_.push_back({weights.face.empty() ? 1 : weights.face[f], {}});
      // Each face has points of its own; those of neighbours are joined to them, at a cost where there is a fence.
      for (Index k = 0; k < 3; ++k) {
        const Index a = mesh.faces()[f][k], b = mesh.faces()[f][(k + 1) % 3];
        for (Index i = 0; i < steps; ++i) {
          faces_.back().nodes.push_back(static_cast<Index>(places_.size()));
          const double t = static_cast<double>(i) / steps;
          places_.push_back((1 - t) * mesh.positions()[a] + t * mesh.positions()[b]);
          owner_.push_back(f);
        }
      }
    }
    twins_.resize(places_.size());
    roads_.resize(places_.size());
    join(weights);
  }

  // Faces that have no more than a vertex in common meet there: of meshes without fences and walls only.
  void join_at_vertices() {
    std::vector<Index> first(mesh_.vertex_count(), kNoIndex);
    for (Index node = 0; node < places_.size(); ++node) {
      const Index v = vertex_of(node);
      if (v == kNoIndex) continue;
      if (first[v] == kNoIndex) first[v] = node;
      twins_[node].emplace_back(first[v], 0);
      twins_[first[v]].emplace_back(node, 0);
    }
  }

  // From vertex `source` to every vertex.
  std::vector<double> from(Index source) const {
    std::vector<double> value(places_.size(), kInfinity);
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto offer = [&](Index node, double v) {
      if (v < value[node]) queue.emplace(value[node] = v, node);
    };
    for (Index node = 0; node < places_.size(); ++node) {
      if (vertex_of(node) == source && faces_[owner_[node]].weight < kInfinity) offer(node, 0);
      if (vertex_of(node) == source && !roads_[node].empty()) offer(node, 0);
    }
    while (!queue.empty()) {
      const auto [v, node] = queue.top();
      queue.pop();
      if (v > value[node]) continue;
      const double weight = faces_[owner_[node]].weight;
      if (weight < kInfinity) {
        for (const Index other : faces_[owner_[node]].nodes) {
          offer(other, v + weight * norm(places_[other] - places_[node]));
        }
      }
      for (const auto& [other, cost] : twins_[node]) offer(other, v + cost);
      for (const auto& [other, cost] : roads_[node]) offer(other, v + cost);
    }
    std::vector<double> result(mesh_.vertex_count(), kInfinity);
    for (Index node = 0; node < places_.size(); ++node) {
      if (vertex_of(node) == kNoIndex) continue;
      double& least = result[vertex_of(node)];
      least = std::min(least, value[node]);
    }
    return result;
  }

 private:
  struct FaceNodes {
    double weight;
    std::vector<Index> nodes;
  };

  Index vertex_of(Index node) const {
    const Index k = node % (3 * steps_) / steps_;
    return node % steps_ == 0 ? mesh_.faces()[owner_[node]][k] : kNoIndex;
  }
  // The node of face f at step i of the edge from its vertex a to its vertex b.
  Index node(Index f, Index a, Index b, Index i) const {
    const Face& t = mesh_.faces()[f];
    for (Index k = 0; k < 3; ++k) {
      if (t[k] == a && t[(k + 1) % 3] == b) return 3 * steps_ * f + (k * steps_ + i) % (3 * steps_);
      if (t[k] == b && t[(k + 1) % 3] == a) return 3 * steps_ * f + (k * steps_ + steps_ - i) % (3 * steps_);
    }
    return kNoIndex;
  }

  void join(const Weights& weights) {
    std::map<std::pair<Index, Index>, std::vector<Index>> edges;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      for (Index k = 0; k < 3; ++k) {
        const auto ends = std::minmax(mesh_.faces()[f][k], mesh_.faces()[f][(k + 1) % 3]);
        edges[{ends.first, ends.second}].push_back(f);
      }
    }
    std::map<std::pair<Index, Index>, EdgeCost> special;
    for (const EdgeCost& e : weights.edges) special[std::minmax(e.vertices[0], e.vertices[1])] = e;
    for (auto& [ends, faces] : edges) {
      const auto is_wall = [&](Index f) {
        return faces_[f].weight == kInfinity;
      };  // leads nowhere, nor around a vertex
      faces.erase(std::remove_if(faces.begin(), faces.end(), is_wall), faces.end());
      const auto found = special.find(ends);
      const double crossing = found == special.end() ? 0 : found->second.crossing;
      const double along = found == special.end() ? kInfinity : found->second.along;
      const double step = norm(mesh_.positions()[ends.first] - mesh_.positions()[ends.second]) / steps_;
      for (const Index f : faces) {
        for (Index i = 0; i <= steps_; ++i) {
          const Index here = node(f, ends.first, ends.second, i);
          for (const Index g : faces) {
            if (f != g && crossing < kInfinity)
              twins_[here].emplace_back(node(g, ends.first, ends.second, i), crossing);
          }
          if (i == steps_ || along == kInfinity) continue;
          const Index next = node(f, ends.first, ends.second, i + 1);
          roads_[here].emplace_back(next, along * step);
          roads_[next].emplace_back(here, along * step);
        }
      }
    }
  }

  const Mesh& mesh_;
  Index steps_;
  std::vector<FaceNodes> faces_;
  std::vector<Vec3> places_;
  std::vector<Index> owner_;
  std::vector<std::vector<std::pair<Index, double>>> twins_, roads_;
};

}  // namespace brushfire::testing_support
