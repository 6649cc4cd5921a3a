// Blocks by powers of two, and the chains of lists that wait at halfedges.
#include <brushfire/solvers/windows/store/exact_lists.h>

#include <algorithm>
#include <bit>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

WindowBlock BlockPool::allocate(Index windows) {
  WindowBlock block;
  block.size_class = static_cast<unsigned>(std::bit_width((std::max(windows, Index{1}) - 1) >> 2));
  std::vector<std::byte*>& free = free_[block.size_class];
  if (!free.empty()) {
    block.data = free.back();
    free.pop_back();
    return block;
  }
  const std::size_t n = block.capacity(), size = n * (5 * sizeof(Real) + sizeof(Index));
  if (size > left_) {
    chunks_.emplace_back(std::max(size, kChunk));
    if (size > kChunk) {  // a chunk of its own; the current one stays in use
      block.data = chunks_.back().data();
      return block;
    }
    unused_ = chunks_.back().data();
    left_ = kChunk;
  }
  block.data = unused_;
  unused_ += size;
  left_ -= size;
  return block;
}

void BlockPool::clear() {
  // First, and in a pool without chunks, too: it may have been given blocks of another one's.
  for (std::vector<std::byte*>& free : free_) free.clear();
  if (chunks_.empty()) return;
  chunks_.resize(1);
  unused_ = chunks_.front().data();
  left_ = chunks_.front().size();
}

Index ExactLists::allocate_link() {
  if (free_link_ == kNoIndex) {
    links_.emplace_back();
    return static_cast<Index>(links_.size() - 1);
  }
  const Index link = free_link_;
  free_link_ = links_[link].next;
  return link;
}

void ExactLists::put(Index& first, Index h, Origin origin, const WindowList& list) {
  const Index added = allocate_link();
  Index before = kNoIndex, after = first;
  while (after != kNoIndex &&
         (links_[after].halfedge < h || (links_[after].halfedge == h && links_[after].origin <= origin))) {
    before = after;
    after = links_[after].next;
  }
  Link& link = links_[added];
  link = {list, kInfinity, h, after, origin};
  if (before == kNoIndex) {
    first = added;
  } else {
    links_[before].next = added;
  }
  if (before != kNoIndex && links_[before].halfedge == h) {
    if (links_[before].origin == origin) link.list.ordered = false;
  } else if (after != kNoIndex && links_[after].halfedge == h) {
    link.key = links_[after].key;
  }
}

void ExactLists::put(Index& first, Index h, Origin origin, const Window& w, BlockPool& blocks) {
  for (Index p = find(first, h); p != kNoIndex && links_[p].halfedge == h; p = links_[p].next) {
    WindowList& list = links_[p].list;
    if (links_[p].origin != origin || list.size == list.block.capacity()) continue;
    list.block.columns().set(list.size++, w);
    list.ordered = false;
    list.mixed = list.mixed || w.kind == WindowKind::Linear;
    return;
  }
  WindowList list;
  list.block = blocks.allocate(1);
  list.block.columns().set(0, w);
  list.size = 1;
  list.mixed = w.kind == WindowKind::Linear;
  put(first, h, origin, list);
}

WindowList ExactLists::take(Index& first, Index h, BlockPool& blocks) {
  Index* link = &first;
  while (links_[*link].halfedge != h) link = &links_[*link].next;
  const Index head = *link;
  Index last = head, total = links_[head].list.size;
  for (Index p = links_[head].next; p != kNoIndex && links_[p].halfedge == h; p = links_[p].next) {
    total += links_[p].list.size;
    last = p;
  }
  const Index end = links_[last].next;
  *link = end;
  WindowList result = links_[head].list;
  if (last != head) {
    result = {blocks.allocate(total), 0, 0, true};
    const WindowColumns all = result.block.columns();
    for (Index p = head; p != end; p = links_[p].next) {
      const WindowList& part = links_[p].list;
      copy_windows(part.block.columns(), all.from(result.size), part.size);
      result.size += part.size;
      result.age = std::max(result.age, part.age);
      result.mixed = result.mixed || part.mixed;
      result.ordered = result.ordered && part.ordered && links_[p].origin != Origin::Anywhere;
      blocks.release(part.block);
    }
  }
  links_[last].next = free_link_;
  free_link_ = head;
  return result;
}

void ExactLists::prefetch_windows(Index first) const {
  constexpr std::size_t kLine = 64, kMost = 16;  // lines
  if (first == kNoIndex) return;
  const WindowList& list = links_[first].list;
  const std::size_t column = list.block.capacity() * sizeof(Real), used = list.size * sizeof(Real);
  std::size_t lines = 0;
  for (std::size_t c = 0; c < 5; ++c) {
    for (std::size_t at = 0; at < used && lines < kMost; at += kLine, ++lines) {
      prefetch(list.block.data + c * column + at);
    }
  }
}

void ExactLists::clear() {
  links_.clear();
  free_link_ = kNoIndex;
}

}  // namespace brushfire::windows::BRUSHFIRE_NUMBERS
