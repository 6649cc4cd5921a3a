// Blocks by powers of two, and the chains of lists that wait at halfedges.
#include <brushfire/solvers/windows/store/exact_lists.h>

#include <algorithm>
#include <bit>

namespace brushfire::windows::BRUSHFIRE_NUMBERS {

std::byte* BlockPool::cut(std::size_t size) {
  if (size > left_) {
    chunks_.emplace_back(std::max(size, kChunk) + kLine);
    if (size > kChunk) return first_line(chunks_.back());  // a chunk of its own; the current one stays in use
    unused_ = first_line(chunks_.back());
    left_ = kChunk;
  }
  std::byte* const block = unused_;
  unused_ += size;
  left_ -= size;
  return block;
}

std::byte* BlockPool::first_line(std::vector<std::byte>& chunk) {
  const auto at = reinterpret_cast<std::uintptr_t>(chunk.data());
  return chunk.data() + ((at + kLine - 1) / kLine * kLine - at);
}

void BlockPool::clear() {
  // First, and in a pool without chunks, too: it may have been given blocks of another one's.
  for (std::vector<std::byte*>& free : free_) free.clear();
  if (chunks_.empty()) return;
  chunks_.resize(1);
  unused_ = first_line(chunks_.front());
  left_ = chunks_.front().size() - kLine;
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
    result = {blocks.allocate(total + kRoomBehind - 1), 0, 0, true};
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
  constexpr std::size_t kMost = 16;  // lines
  if (first == kNoIndex) return;
  const WindowList& list = links_[first].list;
  if (list.block.size_class <= 1) {
    const std::byte* const end = list.block.data + list.block.bytes();
    for (const std::byte* line = list.block.data; line != end; line += kLine) prefetch(line);
    return;
  }
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
