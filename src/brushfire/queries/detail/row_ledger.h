// Which rows of a matrix on disk are there: a file beside it that several processes keep at the same time.
//
// The file: a head of 1024 bytes (what the matrix is of), the numbers of its rows where they are not all (8 bytes
// each), and a byte for each row, 0 until the row is in place. A lock on that byte is held by who computes the row:
// locks go with the process however it ends, so that whatever a killed one was at is free again, and a row that is
// marked was written before.
#pragma once

#include <brushfire/io/detail/shared_file.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace brushfire::detail {

struct LedgerHead {
  std::uint64_t matrix = 0;                              // what it is of: fingerprint_of()
  std::uint64_t layout = 0;                              // how it is stored
  std::uint64_t rows = 0, columns = 0, value_bytes = 0;  // of the whole matrix
  std::uint64_t shard = 1, shards = 1;
  std::uint64_t all_vertices = 0;  // 1: the rows are all vertices, in order; 2: the columns are; 3: both
  std::uint64_t entries = 0;       // rows (or blocks of rows) that this ledger is of
  std::string words;               // the same for people; cut to what has room
};

class RowLedger {
 public:
  // Goes on with the ledger at `path`, or begins one: `begin` then makes the files for the rows, and `is_there` says
  // whether they are where a ledger was found. `numbers`: the rows' numbers in the whole matrix; empty: all. Throws
  // Error(FileNotWritable) where the ledger is that of another matrix.
  RowLedger(std::string path, LedgerHead head, const std::vector<std::uint64_t>& numbers,
            const std::function<bool()>& is_there, const std::function<void()>& begin);

  std::size_t entries() const { return static_cast<std::size_t>(head_.entries); }
  // How many were there when this process came.
  std::size_t found() const { return found_; }
  bool is_done(std::size_t entry) const;
  bool are_done(std::size_t begin, std::size_t end) const;
  std::size_t done() const;
  std::vector<std::size_t> missing(std::size_t begin, std::size_t end) const;

  // True where the entry is neither there nor somebody else's: it is this process's then, until release().
  bool claim(std::size_t entry) const;
  void mark(std::size_t entry) const;  // it is in place
  void release(std::size_t entry) const;
  // Whether nobody is at it.
  bool is_free(std::size_t entry) const;

  // Calls `complete` unless another process has done so: one at a time, under a lock. It ends in remove() or keep_as().
  void finish(const std::function<void()>& complete) const;
  void remove() const;
  void keep_as(const std::string& path) const;

  // What stands in a ledger; nullopt where there is none.
  struct Content {
    LedgerHead head;
    std::vector<std::uint64_t> numbers;  // empty: all
    std::size_t done = 0;
  };
  static std::optional<Content> read(const std::string& path);

 private:
  bool open_existing(const std::function<bool()>& is_there);
  void begin_new(const std::vector<std::uint64_t>& numbers, const std::function<void()>& begin);
  std::uint64_t at(std::size_t entry) const { return states_ + entry; }

  std::string path_;
  LedgerHead head_;
  std::optional<SharedFile> file_;
  std::uint64_t states_ = 0;  // where they begin
  std::size_t found_ = 0;
};

}  // namespace brushfire::detail
