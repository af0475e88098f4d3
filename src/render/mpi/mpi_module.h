// What drude-mpi.so offers: plain C types only, so that neither side depends on the other's
// headers, and no exception crosses the border.
#pragma once

#include <cstddef>

extern "C" {

// Raised whenever a signature below changes; the loader refuses another number.
inline constexpr int drude_mpi_interface = 1;

int drude_mpi_version();
// Joins the processes of the launcher. 0, or 1 with a message.
int drude_mpi_start(int* rank, int* size, char* message, size_t message_size);
// Whether `mine` is not 0 in any process; every process must call it.
int drude_mpi_any(int mine);
// Bytes to process 0, and there from another one; they return when the bytes may be reused. MPI
// ends all processes where one of them is gone.
void drude_mpi_send(const void* bytes, size_t count);
void drude_mpi_receive(int from, void* bytes, size_t count);
// Waits for the others to come to their end, too.
void drude_mpi_finish();
}
