// What one part of the mesh has to tell others: it waits in the sender's outbox until all parts have stopped.
#pragma once

#include <brushfire/solvers/windows/algebra/rays.h>
#include <brushfire/solvers/windows/algebra/window.h>
#include <brushfire/solvers/windows/store/exact_lists.h>

#include <vector>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

struct Mail {
  // A root, with its label: to be known before what comes from there. Of runs with several sources.
  struct Label {
    Index part, root, label;
  };
  // A window or a source sees a vertex: to each of its other copies.
  struct Offer {
    Index vertex;
    Real value;
    Ray ray;
    bool all_around;
  };
  struct ToTarget {
    Index target;
    Real value, slack, lift;
    Ray ray;
    bool straight;
  };
  struct OneWindow {
    Index halfedge;
    Origin origin;
    Window window;
  };
  struct WholeList {
    Index halfedge;
    Origin origin;
    WindowList list;
  };

  std::vector<Label> labels;
  std::vector<Index> news;  // vertices whose upper bound fell, each once: copies are to know
  std::vector<Offer> offers;
  std::vector<ToTarget> to_targets;
  std::vector<OneWindow> windows;
  std::vector<WholeList> lists;

  bool empty() const {
    return news.empty() && offers.empty() && to_targets.empty() && windows.empty() && lists.empty();
  }
  void clear() {
    labels.clear();
    news.clear();
    offers.clear();
    to_targets.clear();
    windows.clear();
    lists.clear();
  }
};

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
