// The ledger's bytes and locks.
#include <brushfire/queries/detail/row_ledger.h>

#include <brushfire/core/error.h>
#include <brushfire/io/detail/binary.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

namespace brushfire::detail {
namespace {

constexpr std::size_t kHeadBytes = 1024;
constexpr std::string_view kMagic = "BRF-ROWS";
constexpr std::size_t kNumbersInHead = 9;                 // behind the magic; then the words, ended by 0
constexpr std::uint64_t kBeginLock = 0, kFinishLock = 1;  // bytes of the magic

std::string encoded(const LedgerHead& h) {
  std::string bytes(kMagic);
  for (const std::uint64_t n :
       {h.matrix, h.layout, h.rows, h.columns, h.value_bytes, h.shard, h.shards, h.all_vertices, h.entries}) {
    char raw[8];
    store(n, raw, std::endian::little);
    bytes.append(raw, sizeof raw);
  }
  bytes += h.words.substr(0, kHeadBytes - bytes.size() - 1);
  bytes.resize(kHeadBytes, '\0');
  return bytes;
}

std::uint64_t number_at(std::string_view bytes, std::size_t k) {
  return load<std::uint64_t>(bytes.data() + kMagic.size() + 8 * k, std::endian::little);
}

std::optional<LedgerHead> head_of(const SharedFile& file) {
  std::string bytes(kHeadBytes, '\0');
  if (!file.read(0, bytes) || !bytes.starts_with(kMagic)) return std::nullopt;
  LedgerHead h;
  std::size_t k = 0;
  for (std::uint64_t* n :
       {&h.matrix, &h.layout, &h.rows, &h.columns, &h.value_bytes, &h.shard, &h.shards, &h.all_vertices, &h.entries})
    *n = number_at(bytes, k++);
  h.words = bytes.c_str() + kMagic.size() + 8 * kNumbersInHead;
  return h;
}

std::size_t count_done(const std::string& states) {
  return static_cast<std::size_t>(std::count_if(states.begin(), states.end(), [](char c) { return c != 0; }));
}

std::string states_of(const SharedFile& file, std::uint64_t from, std::size_t count) {
  std::string states(count, '\0');
  return file.read(from, states) ? states : std::string(count, '\0');
}

// It is the first that is made, so a folder that is not there or may not be written to shows here: of the matrix's own
// name is spoken then.
SharedFile made_or_opened(const std::string& path) {
  try {
    return {path, SharedFile::Missing::Created};
  } catch (const Error& error) {
    const std::string matrix = path.substr(0, path.rfind(".part.rows"));
    throw Error(error.code(), matrix + ": no file can be made beside it for the rows that are done (" + error.what() +
                                  "). Choose a folder that can be written to");
  }
}

}  // namespace

RowLedger::RowLedger(std::string path, LedgerHead head, const std::vector<std::uint64_t>& numbers,
                     const std::function<bool()>& is_there, const std::function<void()>& begin)
    : path_(std::move(path)), head_(std::move(head)), states_(kHeadBytes + 8 * numbers.size()) {
  do {
    file_.emplace(made_or_opened(path_));
    file_->lock(kBeginLock);
  } while (!file_->is_at(path_));  // completed and removed in the meantime
  if (!open_existing(is_there)) begin_new(numbers, begin);
  file_->unlock(kBeginLock);
}

bool RowLedger::open_existing(const std::function<bool()>& is_there) {
  const std::optional<LedgerHead> there = head_of(*file_);
  if (!there) return false;
  const std::string states = states_of(*file_, states_, entries());
  if (there->matrix != head_.matrix || there->layout != head_.layout || there->entries != head_.entries ||
      there->shard != head_.shard || there->shards != head_.shards) {
    throw Error(ErrorCode::FileNotWritable, path_ + ": another matrix was begun here (" + there->words +
                                                "). Complete it with the command that began it, remove it (" + path_ +
                                                " first), or choose another name");
  }
  if (!is_there()) return false;
  found_ = count_done(states);
  return true;
}

void RowLedger::begin_new(const std::vector<std::uint64_t>& numbers, const std::function<void()>& begin) {
  try {
    file_->resize(0);  // from here on it is no ledger, until its head is there
    file_->resize(states_ + entries());
    begin();
    std::string bytes(8 * numbers.size(), '\0');
    for (std::size_t k = 0; k < numbers.size(); ++k) store(numbers[k], bytes.data() + 8 * k, std::endian::little);
    file_->write(kHeadBytes, bytes);
    file_->write(0, encoded(head_));
  } catch (...) {
    std::remove(path_.c_str());
    throw;
  }
}

bool RowLedger::is_done(std::size_t entry) const {
  char state = 0;
  return file_->read(at(entry), std::span(&state, 1)) && state != 0;
}

bool RowLedger::are_done(std::size_t begin, std::size_t end) const {
  return count_done(states_of(*file_, at(begin), end - begin)) == end - begin;
}

std::size_t RowLedger::done() const { return count_done(states_of(*file_, states_, entries())); }

std::vector<std::size_t> RowLedger::missing(std::size_t begin, std::size_t end) const {
  const std::string states = states_of(*file_, at(begin), end - begin);
  std::vector<std::size_t> list;
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (states[k] == 0) list.push_back(begin + k);
  }
  return list;
}

bool RowLedger::claim(std::size_t entry) const {
  if (is_done(entry) || !file_->try_lock(at(entry))) return false;
  if (!is_done(entry)) return true;  // read again: it may have been completed before the lock was there
  release(entry);
  return false;
}

void RowLedger::mark(std::size_t entry) const {
  constexpr char kDone = 1;
  file_->write(at(entry), std::span(&kDone, 1));
}

void RowLedger::release(std::size_t entry) const { file_->unlock(at(entry)); }

bool RowLedger::is_free(std::size_t entry) const {
  if (!file_->try_lock(at(entry))) return false;
  release(entry);
  return true;
}

void RowLedger::finish(const std::function<void()>& complete) const {
  file_->lock(kFinishLock);
  if (file_->is_at(path_)) complete();
  file_->unlock(kFinishLock);
}

void RowLedger::remove() const { std::remove(path_.c_str()); }

void RowLedger::keep_as(const std::string& path) const {
  std::error_code error;
  std::filesystem::rename(path_, path, error);
  if (error) throw Error(ErrorCode::FileNotWritable, path + ": " + error.message());
}

std::optional<RowLedger::Content> RowLedger::read(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  const SharedFile file(path, SharedFile::Missing::Refused);
  Content content;
  if (const std::optional<LedgerHead> head = head_of(file)) {
    content.head = *head;
  } else {
    return std::nullopt;
  }
  const std::uint64_t size = file.size(), entries = content.head.entries;
  if (size < kHeadBytes + entries || (size - kHeadBytes - entries) % 8 != 0) return std::nullopt;
  content.numbers.resize(static_cast<std::size_t>((size - kHeadBytes - entries) / 8));
  std::string bytes(8 * content.numbers.size(), '\0');
  if (!file.read(kHeadBytes, bytes)) return std::nullopt;
  for (std::size_t k = 0; k < content.numbers.size(); ++k) {
    content.numbers[k] = load<std::uint64_t>(bytes.data() + 8 * k, std::endian::little);
  }
  content.done = count_done(states_of(file, size - entries, static_cast<std::size_t>(entries)));
  return content;
}

}  // namespace brushfire::detail
