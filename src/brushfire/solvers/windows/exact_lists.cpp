// Blocks by powers of two, and the chains of lists that wait at halfedges.
#include <brushfire/solvers/windows/detail/exact_lists.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace brushfire::detail {

void copy_windows(const WindowColumns& from, const WindowColumns& to, Index count) {
  std::memcpy(to.b0, from.b0, count * sizeof(double));
  std::memcpy(to.b1, from.b1, count * sizeof(double));
  std::memcpy(to.x, from.x, count * sizeof(double));
  std::memcpy(to.y, from.y, count * sizeof(double));
  std::memcpy(to.sigma, from.sigma, count * sizeof(double));
  std::memcpy(to.root, from.root, count * sizeof(Index));
}

WindowBlock BlockPool::allocate(Index windows) {
  WindowBlock block;
  block.size_class = static_cast<unsigned>(std::bit_width((std::max(windows, Index{1}) - 1) >> 2));
  std::vector<std::byte*>& free = free_[block.size_class];
  if (!free.empty()) {
    block.data = free.back();
    free.pop_back();
    return block;
  }
  const std::size_t n = block.capacity(), size = n * (5 * sizeof(double) + sizeof(Index));
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
  if (chunks_.empty()) return;
  chunks_.resize(1);
  unused_ = chunks_.front().data();
  left_ = chunks_.front().size();
  for (std::vector<std::byte*>& free : free_) free.clear();
}

Index ExactLists::allocate_part() {
  if (free_part_ == kNoIndex) {
    parts_.emplace_back();
    keys_.push_back(kInfinity);
    return static_cast<Index>(parts_.size() - 1);
  }
  const Index part = free_part_;
  free_part_ = parts_[part].next;
  return part;
}

void ExactLists::put(Index h, Origin origin, const WindowList& list) {
  const Index added = allocate_part();
  Part& part = parts_[added];
  part.list = list;
  part.origin = origin;
  const Index head = first_[h];
  if (head == kNoIndex || origin < parts_[head].origin) {
    part.next = head;
    keys_[added] = head == kNoIndex ? kInfinity : keys_[head];
    first_[h] = added;
    return;
  }
  Index before = head;
  while (parts_[before].next != kNoIndex && parts_[parts_[before].next].origin <= origin) before = parts_[before].next;
  if (parts_[before].origin == origin) part.list.ordered = false;
  part.next = parts_[before].next;
  parts_[before].next = added;
}

void ExactLists::put(Index h, Origin origin, const Window& w) {
  for (Index p = first_[h]; p != kNoIndex; p = parts_[p].next) {
    WindowList& list = parts_[p].list;
    if (parts_[p].origin != origin || list.size == list.block.capacity()) continue;
    list.block.columns().set(list.size++, w);
    list.ordered = false;
    return;
  }
  WindowList list;
  list.block = blocks_.allocate(1);
  list.block.columns().set(0, w);
  list.size = 1;
  put(h, origin, list);
}

WindowList ExactLists::take(Index h) {
  const Index head = first_[h];
  first_[h] = kNoIndex;
  WindowList result = parts_[head].list;
  Index last = head;
  if (parts_[head].next != kNoIndex) {
    Index total = 0;
    for (Index p = head; p != kNoIndex; p = parts_[p].next) total += parts_[p].list.size;
    result = {blocks_.allocate(total), 0, 0, true};
    const WindowColumns all = result.block.columns();
    for (Index p = head; p != kNoIndex; p = parts_[p].next) {
      const WindowList& part = parts_[p].list;
      copy_windows(part.block.columns(), all.from(result.size), part.size);
      result.size += part.size;
      result.age = std::max(result.age, part.age);
      result.ordered = result.ordered && part.ordered && parts_[p].origin != Origin::Anywhere;
      blocks_.release(part.block);
      last = p;
    }
  }
  parts_[last].next = free_part_;
  free_part_ = head;
  return result;
}

void ExactLists::prefetch_windows(Index h) const {
  constexpr std::size_t kLine = 64, kMost = 16;  // lines
  if (first_[h] == kNoIndex) return;
  const WindowList& list = parts_[first_[h]].list;
  const std::size_t column = list.block.capacity() * sizeof(double), used = list.size * sizeof(double);
  std::size_t lines = 0;
  for (std::size_t c = 0; c < 5; ++c) {
    for (std::size_t at = 0; at < used && lines < kMost; at += kLine, ++lines) {
      prefetch(list.block.data + c * column + at);
    }
  }
}

void ExactLists::clear() {
  std::fill(first_.begin(), first_.end(), kNoIndex);
  parts_.clear();
  keys_.clear();
  free_part_ = kNoIndex;
  blocks_.clear();
}

}  // namespace brushfire::detail
