// How a matrix is cut into shards and blocks, and what they are called.
#pragma once

#include <brushfire/queries/detail/row_ledger.h>
#include <brushfire/queries/detail/rows.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace brushfire::detail {

// Of `count` blocks of about as many rows each number `block` (from 0 on): whole units, so that nothing is computed
// twice.
std::vector<std::size_t> block_of(const Rows::ByUnits& units, std::uint64_t block, std::uint64_t count);

// "d.npy" to "d.03-of-16.npy".
std::filesystem::path shard_path(const std::filesystem::path& path, std::uint64_t shard, std::uint64_t shards);

// What a Zarr store says about itself: members of a JSON object.
std::string attributes_of(const LedgerHead& head);

// Six digits.
std::string readable_number(double value);

}  // namespace brushfire::detail
