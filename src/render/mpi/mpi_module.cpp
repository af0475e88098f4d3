// drude-mpi.so: the few calls of MPI that processes rendering together need.
#include "render/mpi/mpi_module.h"

// The C interface alone: the C++ one is gone from the standard.
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <algorithm>
#include <cstdio>

namespace {

// Counts of MPI are int; rows of a film are far shorter, but nothing here needs to know.
constexpr size_t most_at_once = size_t{1} << 30;
constexpr int tag = 0;

template <class Call>
void in_pieces(size_t count, const Call& call) {
    for (size_t done = 0; done < count;) {
        const size_t piece = std::min(count - done, most_at_once);
        call(done, static_cast<int>(piece));
        done += piece;
    }
}

}  // namespace

extern "C" {

int drude_mpi_version() {
    return drude_mpi_interface;
}

int drude_mpi_start(int* rank, int* size, char* message, size_t message_size) {
    int provided = 0;
    const int code = MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    if (code != MPI_SUCCESS || provided < MPI_THREAD_FUNNELED) {
        std::snprintf(message, message_size, "it offers no threads beside the one that calls it");
        return 1;
    }
    MPI_Comm_rank(MPI_COMM_WORLD, rank);
    MPI_Comm_size(MPI_COMM_WORLD, size);
    return 0;
}

int drude_mpi_any(int mine) {
    int all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return all;
}

void drude_mpi_send(const void* bytes, size_t count) {
    in_pieces(count, [&](size_t from, int piece) {
        MPI_Send(static_cast<const char*>(bytes) + from, piece, MPI_BYTE, 0, tag, MPI_COMM_WORLD);
    });
}

void drude_mpi_receive(int from, void* bytes, size_t count) {
    in_pieces(count, [&](size_t at, int piece) {
        MPI_Recv(static_cast<char*>(bytes) + at, piece, MPI_BYTE, from, tag, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
    });
}

void drude_mpi_finish() {
    MPI_Finalize();
}
}
