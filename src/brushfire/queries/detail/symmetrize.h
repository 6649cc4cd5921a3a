// Both directions of a square matrix on disk made equal, so that being killed in its midst does no harm.
#pragma once

#include <brushfire/queries/detail/matrix_store.h>

#include <string>

namespace brushfire::detail {

// A pair of blocks at a time: the values d(i, j) of one and d(j, i) of the other. Before a pair is written it is put
// aside in the file `journal` as it was (the mean of a mean and a number is another one), from where it is begun anew
// when this is called again after a kill. The journal is there as long as the matrix is not symmetric throughout.
void symmetrize(const MatrixStore& store, std::uint64_t size, ValueType type, Symmetry symmetry,
                const std::string& journal);

}  // namespace brushfire::detail
