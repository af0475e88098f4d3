// Processes that render one picture together, each its own batches.
#pragma once

#include <cstddef>
#include <memory>

#include "render/film_job.h"
#include "render/film_sums.h"

namespace drude {

struct RenderedFilm;

class Ranks {
  public:
    virtual ~Ranks() = default;
    virtual int rank() const = 0;  // in [0, size)
    virtual int size() const = 0;
    // Whether `mine` is true in any process; every process must call it.
    virtual bool any(bool mine) const = 0;
    // Bytes to rank 0, and on rank 0 from another one, in the order of sending.
    virtual void send(const void* bytes, size_t count) const = 0;
    virtual void receive(int from, void* bytes, size_t count) const = 0;
    // At the end of a run that went well, whatever its answer: waits for the others to get there.
    // A process that fails must not call it, so that the launcher sees it go and ends the others,
    // which wait for this one.
    virtual void finish() const = 0;
};

// Every process calls it with its own film; rank 0's then holds the batches of all.
// Throws Error (user) on rank 0 where the films are not of one job (instruction sets may differ
// with `allow_mixed`), Error (outside) where what arrives is damaged.
void gather_films(const Ranks& ranks, bool allow_mixed, RenderedFilm* film);

// The processes that an MPI launcher (mpirun, srun) has started, this one among them, through the
// module drude-mpi.so; null where there are no others. To be called once.
// Throws Error (outside) where the module or OpenMPI is missing.
std::unique_ptr<const Ranks> mpi_ranks();

}  // namespace drude
