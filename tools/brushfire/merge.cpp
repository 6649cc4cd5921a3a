// brushfire merge: the shards of a matrix, put together.
#include "interrupt.h"
#include "job_progress.h"
#include "matrix_files.h"

#include <brushfire/core/cancel.h>
#include <brushfire/queries/matrix_job.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

namespace brushfire::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  for i in $(seq 16); do brushfire matrix cortex.gii --shard $i/16 -o d.npy; done     # or machine by machine
  brushfire merge d.*-of-16.npy -o d.npy
  brushfire merge d.*-of-16.npy --symmetric mean -o d.zarr

Each shard d.03-of-16.npy has beside it d.03-of-16.npy.rows, which says which rows of which matrix it holds. Shards of
different matrices are refused, and so are missing ones, by number. The result has the bytes of a matrix that was
computed at once; the shards stay. Interrupted, the same command goes on.)";

struct Arguments {
  std::string first, output;
  std::vector<std::string> more;
  MatrixFileArguments file_options;
};

int merge_verb(const Arguments& a, const Talk& talk) {
  if (!is_dense(a.output)) refuse("where to? give -o FILE.npy or .zarr");
  check(a.file_options, a.output);
  const CancelScope listen(&cancel_token());
  std::vector<std::filesystem::path> shards{a.first};
  shards.insert(shards.end(), a.more.begin(), a.more.end());
  const auto start = std::chrono::steady_clock::now();
  merge_shards(shards, a.output, file_options(a.file_options), talk.progress("merge"));
  talk.end_progress();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (talk.json) {
    Record record;
    record.add("shards", static_cast<std::int64_t>(shards.size())).add("seconds", seconds).add("output", a.output);
    write_stdout(record.json());
  } else {
    talk.say(a.output + ": " + counted(shards.size(), "shard", "shards") + ", in " + duration(seconds));
  }
  return kOk;
}

}  // namespace

void add_merge(CommandLine& command_line) {
  const auto arguments = std::make_shared<Arguments>();
  command_line.add("merge", "Put the shards of a distance matrix together", [&](Verb& verb) {
    verb.argument("SHARD", arguments->first, "A file of brushfire matrix --shard");
    verb.arguments("MORE", arguments->more, "The other ones");
    verb.required_option("-o,--output", arguments->output, "FILE", "Write the matrix: .npy or .zarr");
    add_matrix_files(verb, arguments->file_options);
    verb.talks();
    verb.examples(kExamples);
    verb.run([arguments](Talk& talk) { return merge_verb(*arguments, talk); });
  });
}

}  // namespace brushfire::tool
